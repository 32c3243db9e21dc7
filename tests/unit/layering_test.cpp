// Which folder may include what. The layers are what keeps a rigid scene free of deal.II and the
// hanging wall readable on its own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

const std::set<std::string> standard_headers = {"algorithm",
                                                "any",
                                                "array",
                                                "atomic",
                                                "barrier",
                                                "bit",
                                                "bitset",
                                                "cassert",
                                                "cctype",
                                                "cerrno",
                                                "cfenv",
                                                "cfloat",
                                                "charconv",
                                                "chrono",
                                                "cinttypes",
                                                "climits",
                                                "clocale",
                                                "cmath",
                                                "compare",
                                                "complex",
                                                "concepts",
                                                "condition_variable",
                                                "coroutine",
                                                "csetjmp",
                                                "csignal",
                                                "cstdarg",
                                                "cstddef",
                                                "cstdint",
                                                "cstdio",
                                                "cstdlib",
                                                "cstring",
                                                "ctime",
                                                "cuchar",
                                                "cwchar",
                                                "cwctype",
                                                "deque",
                                                "exception",
                                                "execution",
                                                "filesystem",
                                                "format",
                                                "forward_list",
                                                "fstream",
                                                "functional",
                                                "future",
                                                "initializer_list",
                                                "iomanip",
                                                "ios",
                                                "iosfwd",
                                                "iostream",
                                                "istream",
                                                "iterator",
                                                "latch",
                                                "limits",
                                                "list",
                                                "locale",
                                                "map",
                                                "memory",
                                                "memory_resource",
                                                "mutex",
                                                "new",
                                                "numbers",
                                                "numeric",
                                                "optional",
                                                "ostream",
                                                "queue",
                                                "random",
                                                "ranges",
                                                "ratio",
                                                "regex",
                                                "scoped_allocator",
                                                "semaphore",
                                                "set",
                                                "shared_mutex",
                                                "source_location",
                                                "span",
                                                "sstream",
                                                "stack",
                                                "stdexcept",
                                                "stop_token",
                                                "streambuf",
                                                "string",
                                                "string_view",
                                                "syncstream",
                                                "system_error",
                                                "thread",
                                                "tuple",
                                                "type_traits",
                                                "typeindex",
                                                "typeinfo",
                                                "unordered_map",
                                                "unordered_set",
                                                "utility",
                                                "valarray",
                                                "variant",
                                                "vector",
                                                "version"};

bool starts_with(const std::string& text, const std::vector<std::string>& beginnings) {
    for (const auto& beginning : beginnings)
        if (text.starts_with(beginning))
            return true;
    return false;
}

/// @param is_interface  of the footwall: what the program links instead of loading it
bool is_allowed(const std::string& layer, const std::string& header, bool is_interface = false) {
    // A path with ".." could reach anything, and a macro could name anything.
    if (header.find("..") != std::string::npos)
        return false;
    const bool is_standard = standard_headers.contains(header);
    const bool is_finite_element_library =
        starts_with(header, {"deal.II/", "petsc", "slepc", "mpi.h", "p4est", "Epetra", "Teuchos"});
    if (layer == "dem")
        return is_standard || header == "immintrin.h" || // the compiler's own
               header == "sched.h" ||                    // placing threads on cores
               header == "sys/mman.h" ||                 // large pages
               header.starts_with("dem/");
    if (layer == "fem") // the files of the interface keep the library out, as the program sees them
        return (is_interface ? !is_finite_element_library
                             : !starts_with(header, {"fmt/", "toml++/", "nlohmann/", "CLI/"})) &&
               !starts_with(header, {"dem/", "apps/", "coupling/"});
    if (layer == "coupling")
        return is_standard || header == "fem/footwall.hpp" ||
               starts_with(header, {"dem/", "coupling/", "Eigen/"});
    return !is_finite_element_library; // apps
}

std::string without_leading_space(const std::string& text) {
    const auto start = text.find_first_not_of(" \t");
    return start == std::string::npos ? "" : text.substr(start);
}

/// Headers that a source text of the layer includes but must not.
std::vector<std::string> forbidden_includes(const std::string& layer, const std::string& text,
                                            bool is_interface = false) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        line = without_leading_space(line);
        if (!line.starts_with('#'))
            continue;
        line = without_leading_space(line.substr(1));
        if (!line.starts_with("include"))
            continue;
        line = without_leading_space(line.substr(7));
        const bool is_named = line.starts_with('"') || line.starts_with('<');
        const std::string name = is_named ? line.substr(1, line.find_first_of("\">", 1) - 1) : line;
        if (!is_named || !is_allowed(layer, name, is_interface))
            found.push_back(name);
    }
    return found;
}

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Layering, FindsPlantedViolations) {
    EXPECT_THAT(forbidden_includes("dem", "#include <vector>\n"
                                          "#include \"dem/state.hpp\"\n"
                                          "#include \"apps/scene.hpp\"\n"
                                          " #  include <fmt/core.h> // comment\n"
                                          "#include \"../apps/run.hpp\"\n"
                                          "#include \"dem/../fem/mesh.hpp\"\n"
                                          "#include <unistd.h>\n"
                                          "#include HEADER\n"),
                ElementsAre("apps/scene/scene.hpp", "fmt/core.h", "../apps/run.hpp",
                            "dem/../fem/mesh.hpp", "unistd.h", "HEADER"));
    EXPECT_THAT(forbidden_includes("fem", "#include <deal.II/grid/tria.h>\n"
                                          "#include <petscksp.h>\n"
                                          "#include \"fem/mesh.hpp\"\n"
                                          "#include \"dem/state.hpp\"\n"
                                          "#include \"coupling/schemes.hpp\"\n"),
                ElementsAre("dem/state.hpp", "coupling/schemes.hpp"));
    EXPECT_THAT(forbidden_includes("fem", "#include <deal.II/grid/tria.h>\n", true),
                ElementsAre("deal.II/grid/tria.h"));
    EXPECT_THAT(forbidden_includes("coupling", "#include <Eigen/Dense>\n"
                                               "#include <memory>\n"
                                               "#include \"dem/base.hpp\"\n"
                                               "#include \"fem/footwall.hpp\"\n"
                                               "#include \"fem/mesh.hpp\"\n"
                                               "#include <deal.II/lac/vector.h>\n"
                                               "#include \"apps/scene.hpp\"\n"),
                ElementsAre("fem/mesh.hpp", "deal.II/lac/vector.h", "apps/scene/scene.hpp"));
    EXPECT_THAT(forbidden_includes("apps", "#include \"coupling/schemes.hpp\"\n"
                                           "#include <toml++/toml.h>\n"
                                           "#include <deal.II/base/point.h>\n"
                                           "#include <petsc.h>\n"),
                ElementsAre("deal.II/base/point.h", "petsc.h"));
}

TEST(Layering, IgnoresWhatIsNoInclude) {
    EXPECT_THAT(forbidden_includes("dem", "// #include \"apps/scene.hpp\"\nint include;\n"),
                IsEmpty());
}

TEST(Layering, SourcesKeepToTheirLayer) {
    namespace fs = std::filesystem;
    const fs::path root = LISTRIC_SOURCE_DIR;
    const std::set<std::string> with_elements{"mesh", "elasticity", "condensation", "solution"};
    for (const std::string layer : {"dem", "fem", "coupling", "apps"}) {
        if (!fs::exists(root / layer))
            continue; // coupling may have no files yet
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(root / layer)) {
            const std::string extension = entry.path().extension().string();
            if (!std::set<std::string>{".hpp", ".cpp", ".h", ".cc"}.contains(extension))
                continue;
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            const bool is_interface =
                layer == "fem" && !with_elements.contains(entry.path().stem().string());
            EXPECT_THAT(forbidden_includes(layer, text.str(), is_interface), IsEmpty())
                << "in " << fs::relative(entry.path(), root);
            ++files;
        }
        const int expected = layer == "coupling" ? 0 : 1;
        EXPECT_GE(files, expected) << "no sources read in " << layer;
    }
}

} // namespace
