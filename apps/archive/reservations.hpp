#pragma once

#include "apps/archive/folder/run_folder.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric::archive {

/// Reservations of a run for those who show or use it, a sentence each: another version of the
/// program has made it, it has not ended, or its files are not of one run and one moment. None: the
/// run is whole, and this program's.
/// @param tells_makers  false: for calls that tell the versions themselves
std::vector<std::string> reservations(const std::filesystem::path& output,
                                      bool tells_makers = true);

/// Tells them to the user.
void warn_of(const std::filesystem::path& output, const std::vector<std::string>& reservations);

/// The run in a folder, to be shown: warns of its reservations. Throws as RunFolder.
RunFolder shown_run(const std::filesystem::path& output);

/// Makes a folder of files that are derived from a run, which may be somebody else's. Throws
/// StorageError, with the way out.
void make_result_folder(const std::filesystem::path& folder);

/// Whether a page of a run is there and shows all that the run has come to: it names the state of
/// summary.json and is no older; of a run that has not ended, no older than the newest snapshot.
bool is_up_to_date(const std::filesystem::path& page, const std::filesystem::path& output);

} // namespace listric::archive
