// SPDX-License-Identifier: Apache-2.0
#include "wire/library.hpp"

#include <atomic>
#include <cstring>
#include <memory>

#ifdef _WIN32
#define NOMINMAX  // Otherwise it defines macros min and max, which the files after it in a unity build cannot use.
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace coframe::dds {

Functions loaded;

namespace {

bool is_loaded = false;
std::atomic<int> participants = 0;
std::atomic<bool> is_forked = false;

#ifdef _WIN32
void* open_library(const std::string& path) {
  const int size = MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, nullptr, 0);
  std::wstring wide(static_cast<std::size_t>(size), L'\0');
  MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, wide.data(), size);
  // Libraries that it depends on are searched for in its own folder.
  return reinterpret_cast<void*>(LoadLibraryExW(wide.c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH));
}
void* find_symbol(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(reinterpret_cast<HMODULE>(library), name));
}
std::string loader_error() { return "Windows error " + std::to_string(GetLastError()); }
#else
void* open_library(const std::string& path) { return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); }
void* find_symbol(void* library, const char* name) { return dlsym(library, name); }
std::string loader_error() {
  const char* text = dlerror();
  return text == nullptr ? "unknown error" : text;
}
#endif

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(find_symbol(library, name));
  if (function == nullptr) throw std::runtime_error(std::string("has no function ") + name);
}

void expect(bool holds, const char* function) {
  if (!holds) throw std::runtime_error(std::string("has another form of the function ") + function);
}

// Checks the numbers of the errors that the wire distinguishes, by their texts.
void check_errors(const Functions& f) {
  const auto is = [&](Code code, const char* text) { return std::strcmp(f.dds_strretcode(code), text) == 0; };
  expect(
      is(kBadParameter, "Bad Parameter") && is(kPreconditionNotMet, "Precondition Not Met") && is(kTimeout, "Timeout"),
      "dds_strretcode");
}

// Checks that policies are read as they were set: the order and the types of arguments, the numbers of the kinds.
void check_policies(const Functions& f) {
  const std::unique_ptr<Qos, void (*)(Qos*)> qos(f.dds_create_qos(), f.dds_delete_qos);
  std::int32_t kind = -1;
  std::int32_t depth = -1;
  std::int64_t duration = -1;
  f.dds_qset_durability(qos.get(), kTransientLocal);
  expect(f.dds_qget_durability(qos.get(), &kind) && kind == kTransientLocal, "dds_qget_durability");
  f.dds_qset_history(qos.get(), kKeepLast, 7);
  expect(f.dds_qget_history(qos.get(), &kind, &depth) && kind == kKeepLast && depth == 7, "dds_qget_history");
  f.dds_qset_reliability(qos.get(), kReliable, 8);
  expect(f.dds_qget_reliability(qos.get(), &kind, &duration) && kind == kReliable && duration == 8,
         "dds_qget_reliability");
  f.dds_qset_liveliness(qos.get(), kManualByTopic, 9);
  expect(f.dds_qget_liveliness(qos.get(), &kind, &duration) && kind == kManualByTopic && duration == 9,
         "dds_qget_liveliness");
  f.dds_qset_deadline(qos.get(), 10);
  expect(f.dds_qget_deadline(qos.get(), &duration) && duration == 10, "dds_qget_deadline");
  f.dds_qset_lifespan(qos.get(), 11);
  expect(f.dds_qget_lifespan(qos.get(), &duration) && duration == 11, "dds_qget_lifespan");
  const char* partition = "robot1";
  std::uint32_t count = 0;
  char** names = nullptr;
  f.dds_qset_partition(qos.get(), 1, &partition);
  expect(f.dds_qget_partition(qos.get(), &count, &names) && count == 1 && std::strcmp(names[0], partition) == 0,
         "dds_qget_partition");
  f.dds_free(names[0]);
  f.dds_free(names);
  constexpr char user_data[] = "enclave=/;";
  f.dds_qset_userdata(qos.get(), user_data, sizeof user_data);
  void* data = nullptr;
  std::size_t size = 0;
  const bool found = f.dds_qget_userdata(qos.get(), &data, &size);
  const std::unique_ptr<void, void (*)(void*)> given(data, f.dds_free);
  expect(found && size == sizeof user_data && std::memcmp(data, user_data, size) == 0, "dds_qget_userdata");
}

}  // namespace

std::string load(const std::string& path) {
  if (!is_loaded) {
    void* library = open_library(path);
    if (library == nullptr) throw std::runtime_error("cannot be loaded (" + loader_error() + ")");
    Functions found;
#define COFRAME_FIND(result, name, arguments) find(library, #name, found.name);
    COFRAME_DDS_FUNCTIONS(COFRAME_FIND)
#undef COFRAME_FIND
    found.dds_get_entity_sertype =
        reinterpret_cast<decltype(found.dds_get_entity_sertype)>(find_symbol(library, "dds_get_entity_sertype"));
#ifdef _WIN32
    found.ddsi_sertype_v0 = reinterpret_cast<const void*>(1);  // as in Cyclone DDS's header for Windows
#else
    if (found.dds_get_entity_sertype == nullptr) find(library, "ddsi_sertype_v0", found.ddsi_sertype_v0);
#endif
    check_errors(found);
    check_policies(found);
    loaded = found;
    is_loaded = true;
#ifndef _WIN32
    pthread_atfork(nullptr, nullptr, [] { is_forked = is_forked || participants > 0; });
#endif
  }
  return loaded.dds_get_entity_sertype == nullptr ? "0.10" : "11";
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

}  // namespace coframe::dds
