#pragma once
/// @file
/// Files that are there whole or not at all. May include: std.

#include <filesystem>
#include <fstream>
#include <string>

namespace wheelrail::detail {

/// Writes a neighbouring file, `<path>.part`, and renames it: a reader never sees half a file.
/// @return whether that worked; if not, no file is left behind.
[[nodiscard]] inline bool write_whole_file(const std::filesystem::path& path,
                                           const std::string& text) {
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file.good()) std::filesystem::rename(part, path, error);
  if (file.good() && !error) return true;
  std::filesystem::remove(part, error);
  return false;
}

}  // namespace wheelrail::detail
