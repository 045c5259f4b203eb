// SPDX-License-Identifier: Apache-2.0
#include "describe/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "json/input.hpp"
#include "text/file.hpp"

namespace lexican::describe {
namespace {

bool is_of(const codict::Device& device, const Identity& identity) {
  const codict::Field<std::uint32_t>& vendor = device.identity.vendor_number;
  const codict::Field<std::uint32_t>& product = device.identity.product_number;
  return vendor.is_given && product.is_given && vendor.value == identity.vendor && product.value == identity.product;
}

}  // namespace

std::string user_library() {
  const char* const configuration = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  if (configuration != nullptr && *configuration != '\0') {
    return std::string(configuration) + "/lexican/eds";
  }
  return home != nullptr && *home != '\0' ? std::string(home) + "/.config/lexican/eds" : std::string();
}

std::vector<std::string> description_files(const std::string& directory, std::error_code& error) {
  std::vector<std::string> files;
  const std::filesystem::directory_iterator end;
  for (std::filesystem::directory_iterator at(directory, error); !error && at != end; at.increment(error)) {
    std::string extension = at->path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return static_cast<char>(c | 0x20); });
    if (extension == ".eds" || extension == ".dcf" || extension == ".xdd" || extension == ".xdc") {
      files.push_back(at->path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<Known> find_description(const std::string& directory, const Identity& identity) {
  std::error_code ignored;
  std::optional<Known> found;
  for (const std::string& file : description_files(directory, ignored)) {
    std::string why;
    std::optional<Description> description = read_description(file, why);
    if (!description || !is_of(*description->device(), identity)) {
      continue;
    }
    const bool is_revision = description->device()->identity.revision_number.value == identity.revision;
    if (!found || is_revision) {
      found = Known{file, std::move(*description)};
    }
    if (is_revision) {
      break;
    }
  }
  return found;
}

std::optional<Known> store_description(const std::string& directory, const Identity& identity, std::string bytes,
                                       std::string& why) {
  const std::string file =
      fmt::format("{}/{:08X}-{:08X}-{:08X}.eds", directory, identity.vendor, identity.product, identity.revision);
  if (bytes.size() > codict::Source::size_limit) {
    why = "it is too large";
    return std::nullopt;
  }
  std::optional<codict::Input> input = codict::read(codict::Source(file, bytes), why);
  if (!input) {
    return std::nullopt;
  }
  if (!is_of(input->description.devices.front(), identity)) {
    why = "it has another vendor-ID or product code than the device";
    return std::nullopt;
  }
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    why = directory + ": " + error.message();
    return std::nullopt;
  }
  if (codict::write_file(file, bytes, why) == codict::Written::no) {
    return std::nullopt;
  }
  return Known{file, Description(std::move(input->description.devices.front()))};
}

}  // namespace lexican::describe
