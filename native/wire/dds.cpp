// SPDX-License-Identifier: Apache-2.0
#include "wire/dds.hpp"

#include <atomic>
#include <utility>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace coframe::dds {
namespace {

Functions loaded;
bool is_loaded = false;
std::atomic<int> participants = 0;
std::atomic<bool> is_forked = false;

#ifdef _WIN32
void* open_library(const std::string& path) { return reinterpret_cast<void*>(LoadLibraryA(path.c_str())); }
void* find_symbol(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(reinterpret_cast<HMODULE>(library), name));
}
#else
void* open_library(const std::string& path) { return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); }
void* find_symbol(void* library, const char* name) { return dlsym(library, name); }
#endif

template <class Function>
void find(void* library, const char* name, const std::string& path, Function& function) {
  function = reinterpret_cast<Function>(find_symbol(library, name));
  if (function == nullptr) {
    throw std::runtime_error("The DDS library " + path + " has no function " + name +
                             ". coframe requires cyclonedds 11. Install it with: pip install cyclonedds==11.*");
  }
}

}  // namespace

Error::Error(const std::string& what, Code code)
    : std::runtime_error("could not " + what + ": " + loaded.dds_strretcode(code)), code_(code) {}

void load(const std::string& path) {
  if (is_loaded) return;
  void* library = open_library(path);
  if (library == nullptr) throw std::runtime_error("Could not load the DDS library " + path);
  Functions found;
#define COFRAME_FIND(result, name, arguments) find(library, #name, path, found.name);
  COFRAME_DDS_FUNCTIONS(COFRAME_FIND)
#undef COFRAME_FIND
  loaded = found;
  is_loaded = true;
#ifndef _WIN32
  pthread_atfork(nullptr, nullptr, [] { is_forked = is_forked || participants > 0; });
#endif
}

const Functions& functions() {
  if (!is_loaded) throw std::logic_error("The DDS library is not loaded.");
  if (is_forked)
    throw std::logic_error(
        "This process was forked while its parent used DDS, so it cannot use DDS. Start processes with 'spawn'.");
  return loaded;
}

bool forked() noexcept { return is_forked; }

void count_participants(int change) noexcept { participants += change; }

Code check(Code code, const char* what) {
  if (code < 0) throw Error(what, code);
  return code;
}

Entity create_unchecked_topic(Entity participant, const std::string& name, const std::string& type) {
  // One octet and no type description: the type matches by name only, with or without type information on the other
  // side.
  constexpr std::uint32_t kOctetAtOffset = 0x01010000, kEnd = 0;
  constexpr std::uint32_t instructions[] = {kOctetAtOffset, 0, kEnd};
  const TypeDescriptor descriptor{.size = 1,
                                  .alignment = 1,
                                  .flags = 0,
                                  .key_count = 0,
                                  .name = type.c_str(),
                                  .keys = nullptr,
                                  .instruction_count = 2,
                                  .instructions = instructions,
                                  .meta = "",
                                  .type_information = {},
                                  .type_mapping = {},
                                  .representations = 0};
  return check(functions().dds_create_topic(participant, &descriptor, name.c_str(), nullptr, nullptr),
               "create the topic");
}

void release_topic(Entity topic) {
  if (topic < kPublicationTopic) functions().dds_delete(topic);
}

std::vector<Handle> matched_handles(Code (*get)(Entity, Handle*, std::size_t), Entity entity) {
  std::vector<Handle> handles;
  for (;;) {
    const Code count = check(get(entity, handles.data(), handles.size()), "list the matched endpoints");
    const bool all = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (all) return handles;
  }
}

Sample::Sample(Serdata* data, const SampleInfo& info) noexcept : data_(data), info_(info) {
  view_ = loaded.ddsi_serdata_to_ser_ref(data, 0, loaded.ddsi_serdata_size(data), &bytes_);
}

Sample::Sample(Sample&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      view_(std::exchange(other.view_, nullptr)),
      bytes_(other.bytes_),
      info_(other.info_) {}

Sample::~Sample() {
  if (view_ != nullptr) loaded.ddsi_serdata_to_ser_unref(view_, &bytes_);
  if (data_ != nullptr) loaded.ddsi_serdata_unref(data_);
}

std::span<const std::uint8_t> Sample::bytes() const noexcept {
  return {static_cast<const std::uint8_t*>(bytes_.data), static_cast<std::size_t>(bytes_.size)};
}

}  // namespace coframe::dds
