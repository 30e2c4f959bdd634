// SPDX-License-Identifier: MIT
#pragma once
// Files that are either complete or not there.

#include <filesystem>
#include <string>
#include <string_view>

namespace jetlag {

/// How long write_file waits. The disk guards against a loss of power and takes milliseconds; files by the thousand go
/// without.
enum class Until { on_disk, handed_over };

/// Writes the whole text or leaves everything as it was: the text goes to a temporary file in the same folder and only
/// then takes the place of the old file. Readers see the old file or the new one, never a part.
/// Throws std::runtime_error with the path and the system's reason: no folder, disk full, a device and not a file.
void write_file(const std::filesystem::path& path, std::string_view text, Until until = Until::on_disk);

/// What is not finished yet has such a name, beside what it will be: the n-th draft of this process.
std::filesystem::path draft_beside(const std::filesystem::path& target, int n);

/// Removes the drafts in a folder, files and folders, that no one will finish: those of processes that were killed. Only
/// for who holds the folder (result_folder.hpp). A folder that is not there has none.
void sweep_drafts(const std::filesystem::path& folder);

/// The content of a file. Throws std::runtime_error with the path and the system's reason.
std::string read_file(const std::filesystem::path& path);

}  // namespace jetlag
