#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric::archive {

// Which files of a folder are those of a run. Each kind has one strict pattern; names that others
// may give their files, too, are a run's where the file begins as a run's does. What is not listed
// here is nobody's to remove or to write over.

/// Name of the file by which a run tries whether it can write to its folder.
inline constexpr std::string_view write_test = ".listric-write-test";

/// Whether a text occurs in the first so many bytes of a file, or the file is empty.
bool holds(const std::filesystem::path& file, std::string_view mark, std::size_t bytes);

/// The moment, in metres, that the name of a snapshot tells; none: that is no snapshot's name.
std::optional<std::string> moment_of_snapshot(std::string_view name);
std::string snapshot_name(std::string_view moment);

/// The files in a run's folder that a run has made.
std::vector<std::filesystem::path> run_files(const std::filesystem::path& output);

/// Remains of a killed session there: files, and folders of ours.
std::vector<std::filesystem::path> remains(const std::filesystem::path& output);

/// Files of one moment besides its snapshot: the series for ParaView, and pictures
/// as the run draws them.
/// @param metres, kilometres  as MomentNames has them
std::vector<std::filesystem::path> files_of_moment(const std::filesystem::path& output,
                                                   const std::string& metres,
                                                   const std::string& kilometres);

/// A file that lies where a run writes, and that no run has made; none if there is none.
/// @param with_base  whether the run writes tables of its base
/// @param with_series  whether it writes a series for ParaView
std::optional<std::filesystem::path> file_in_the_way(const std::filesystem::path& output,
                                                     bool with_base, bool with_series);

/// Whether a run in `output` would write over a file, or remove it in place of the run there.
bool would_be_lost(const std::filesystem::path& output, const std::filesystem::path& file,
                   bool replaced);

} // namespace listric::archive
