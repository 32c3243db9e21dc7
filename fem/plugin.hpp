#pragma once

#include <string>

namespace listric {

/// A library that the program loads only for those who need it.
struct Plugin {
    const char* variable;  ///< of the environment, that names another file
    const char* installed; ///< its file, from the folder of the program
    const char* built;     ///< its file where it was built; empty: it was not
    const char* entry;     ///< name of its function
};

struct LoadedPlugin {
    void* entry = nullptr; ///< its function; null: there is none
    std::string file;      ///< that was found; empty: none was
    std::string problem;   ///< why it cannot be loaded; empty: it is loaded, with or without entry
};

LoadedPlugin load(const Plugin& plugin);

} // namespace listric
