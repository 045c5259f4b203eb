// SPDX-License-Identifier: Apache-2.0
// The peak memory of codict for large descriptions.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "directory.hpp"
#include "large_xdd.hpp"

using test::Directory;
using test::Large;

namespace {

// A codict without sanitizers, which need several times the memory.
const char* const codict = std::getenv("LEXICAN_CODICT");

// Peak memory of the commands, in times the size of the description.
struct Limits {
  std::size_t check = 8;
  std::size_t convert = 8;
  std::size_t gen = 8;
};

constexpr std::size_t megabyte = 1000000;

// Returns the peak memory of a shell command in bytes; 0 if its exit status is above 1. Linux takes the memory of this
// process at the time of fork() for a peak, too, but it is less.
std::size_t peak_of(const std::string& command) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  struct rusage usage {};
  const bool is_done = child > 0 && ::wait4(child, &status, 0, &usage) == child;
  const bool is_right = is_done && WIFEXITED(status) && WEXITSTATUS(status) < 2;
  return is_right ? static_cast<std::size_t>(usage.ru_maxrss) * 1024 : 0;
}

void check_peak(const std::string& directory, const std::string& command, std::size_t size, std::size_t limit) {
  const std::size_t peak = peak_of("cd '" + directory + "' && exec '" + codict + "' " + command + " >out 2>err");
  CAPTURE(command);
  MESSAGE(command << ": " << static_cast<double>(peak) / static_cast<double>(size) << " times the description");
  CHECK(peak != 0);
  CHECK(peak <= limit * size);
}

// Checks the peak memory of the commands for a description. The second gen compares its files with those of the first.
void check_memory(Large kind, std::size_t bytes, const Limits& limits) {
  const Directory directory;
  const std::string path = directory / "large.xdd";
  std::ofstream(path, std::ios::binary) << test::large_xdd(kind, bytes);
  const std::size_t size = std::filesystem::file_size(path);
  check_peak(directory / "", "check large.xdd", size, limits.check);
  check_peak(directory / "", "convert large.xdd -o large.eds", size, limits.convert);
  check_peak(directory / "", "gen large.xdd -o generated", size, limits.gen);
  check_peak(directory / "", "gen large.xdd -o generated", size, limits.gen);
  CHECK(std::filesystem::exists(directory / "generated/large_od.c"));
}

}  // namespace

TEST_SUITE_BEGIN("memory, needs LEXICAN_CODICT, the path of a codict without sanitizers" *
                 doctest::skip(codict == nullptr));

TEST_CASE("memory: a large XDD of parameters with words needs at most 8 times its size") {
  SUBCASE("objects") { check_memory(Large::objects, 8 * megabyte, {}); }
  SUBCASE("sub-objects") { check_memory(Large::described_sub_objects, 8 * megabyte, {}); }
}

// A sub-object needs 160 bytes of such a description, and 570 bytes of the model.
TEST_CASE("memory: a large XDD of attributes needs at most 10 times its size, 13 times for gen") {
  check_memory(Large::sub_objects, 8 * megabyte, {10, 10, 13});
}

TEST_SUITE_END();
