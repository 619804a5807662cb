// SPDX-License-Identifier: Apache-2.0
#include "core/dump.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace coframe {

namespace {

std::string fixed(double value, int decimals) {
  char text[400];  // a double has up to 309 digits before the point
  return std::string(text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.*f", decimals, value)));
}

double span(const History::View& history) { return to_seconds(history.newest()) - to_seconds(history.oldest()); }

template <class Visit>
void for_each_edge(const Tree& tree, Visit&& visit) {
  for (FrameId id = 1; id < tree.frame_count(); ++id) {
    const History::View history = tree.history(id);
    if (!history.empty()) visit(id, history);
  }
}

// Names that YAML reads as themselves stay bare, as in tf2; others, which break tf2's YAML, are quoted.
std::string yaml_key(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/' || c == '.'; };
  const char first = name.empty() ? ' ' : name.front();
  const bool starts_plainly = std::isalpha(static_cast<unsigned char>(first)) || first == '/' || first == '_';
  if (starts_plainly && std::all_of(name.begin(), name.end(), plain)) {
    return name;
  }
  std::string quoted = "\"";
  for (const unsigned char c : name) {
    char escape[8];
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += static_cast<char>(c);
    } else if (c < 0x20 || c == 0x7f) {
      std::snprintf(escape, sizeof escape, "\\x%02x", c);
      quoted += escape;
    } else {
      quoted += static_cast<char>(c);
    }
  }
  return quoted + '"';
}

std::string yaml_value(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c;
    if (c == '\'') quoted += c;
  }
  return quoted + "'";
}

std::string dot_id(const std::string& name) {
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

double average_rate(const History::View& history) {
  return static_cast<double>(history.size()) / std::max(span(history), 0.0001);
}

std::string frames_as_string(const Tree& tree) {
  std::string text;
  for (FrameId id = 1; id < tree.frame_count(); ++id) {
    const History::View history = tree.history(id);
    if (!history.exists()) continue;
    text += "Frame " + tree.name(id) + " exists with parent " + tree.name(history.parent()) + ".\n";
  }
  return text;
}

std::string frames_as_yaml(const Tree& tree) {
  std::string text;
  for_each_edge(tree, [&](FrameId id, const History::View& history) {
    text += yaml_key(tree.name(id)) + ": \n";
    text += "  parent: " + yaml_value(tree.name(history.parent())) + "\n";
    text += "  broadcaster: " + yaml_value(tree.authority_name(tree.frame(id).authority)) + "\n";
    text += "  rate: " + fixed(average_rate(history), 3) + "\n";
    text += "  most_recent_transform: " + fixed(to_seconds(history.newest()), 6) + "\n";
    text += "  oldest_transform: " + fixed(to_seconds(history.oldest()), 6) + "\n";
    text += "  buffer_length: " + fixed(span(history), 3) + "\n";
  });
  return text.empty() ? "[]" : text;
}

std::string frames_as_dot(const Tree& tree, Stamp now) {
  std::string text = "digraph G {\n";
  if (tree.frame_count() == 1) return text + "\"no tf data recieved\"}";
  for_each_edge(tree, [&](FrameId id, const History::View& history) {
    text += dot_id(tree.name(history.parent())) + " -> " + dot_id(tree.name(id)) + "[label=\"";
    text += "Broadcaster: " + tree.authority_name(tree.frame(id).authority) + "\\n";
    text += "Average rate: " + fixed(average_rate(history), 3) + " Hz\\n";
    text += "Most recent transform: " + fixed(to_seconds(history.newest()), 6) + " ";
    if (now != 0) text += "( " + fixed(to_seconds(now) - to_seconds(history.newest()), 3) + " sec old)";
    text += "\\nBuffer length: " + fixed(span(history), 3) + " sec\\n\"];\n";
  });
  // The legend hangs on every frame without a parent; on emptied ones, as in tf2, even without a time to tell.
  for (FrameId id = 1; id < tree.frame_count(); ++id) {
    if (!tree.frame(id).known) continue;
    const History::View history = tree.history(id);
    if (history.exists() ? !history.empty() : now == 0) continue;
    text += "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; label =\"view_frames Result\";\n";
    if (now != 0) text += "\"Recorded at time: " + fixed(to_seconds(now), 6) + "\"[ shape=plaintext ] ;\n ";
    text += "}->" + dot_id(tree.name(id)) + ";\n";
  }
  return text + "}";
}

}  // namespace coframe
