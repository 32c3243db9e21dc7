#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace listric::support {

/// Verdict of a strict parser (expat) on VTK's files in a folder: "3 of .pvd", sorted, a line for
/// each kind if all are XML; else a line for each that is not.
inline std::string xml_files(const std::filesystem::path& folder) {
    const std::string script = R"(
import collections, pathlib, sys, xml.parsers.expat
kinds, wrong = collections.Counter(), []
for file in sorted(pathlib.Path(sys.argv[1]).rglob('*')):
    if file.suffix in ('.pvd', '.vtp', '.vtu'):
        kinds[file.suffix] += 1
        try:
            xml.parsers.expat.ParserCreate().Parse(file.read_bytes(), True)
        except xml.parsers.expat.ExpatError as error:
            wrong.append(f'{file.name}: {error}')
print(*(wrong or (f'{n} of {kind}' for kind, n in sorted(kinds.items()))), sep='\n'))";
    const std::string call =
        "/usr/bin/python3 -c \"" + script + "\" '" + folder.string() + "' 2>&1";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(call.c_str(), "r"), pclose);
    std::string said;
    for (int c; pipe && (c = std::fgetc(pipe.get())) != EOF;)
        said += static_cast<char>(c);
    return said;
}

} // namespace listric::support
