#include "fem/plugin.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <system_error>

namespace listric {

namespace {

namespace fs = std::filesystem;

std::string find(const Plugin& plugin) {
    if (const char* path = std::getenv(plugin.variable); path && *path)
        return path;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    for (const fs::path& file : {program.parent_path() / plugin.installed, fs::path(plugin.built)})
        if (fs::is_regular_file(file, error))
            return file.string();
    return "";
}

} // namespace

LoadedPlugin load(const Plugin& plugin) {
    LoadedPlugin loaded{nullptr, find(plugin), ""};
    void* library =
        loaded.file.empty() ? nullptr : dlopen(loaded.file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library)
        loaded.entry = dlsym(library, plugin.entry);
    else
        loaded.problem = loaded.file.empty() ? "it is not there" : dlerror();
    return loaded;
}

} // namespace listric
