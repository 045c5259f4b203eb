// SPDX-License-Identifier: Apache-2.0
// System functions that newlib requires, for programs that use its heap or its output.
#include <sys/stat.h>
#include <sys/time.h>

#include <cerrno>
#include <cstddef>

#include "program.hpp"

extern "C" {

extern char board_bss_end[], board_heap_end[];  // defined by sections.ld

void* __dso_handle = nullptr;  // defined by crtbegin.o, which is not linked

void* _sbrk(std::ptrdiff_t increment) {
  static char* end = board_bss_end;
  if (increment > board_heap_end - end) {
    errno = ENOMEM;
    return reinterpret_cast<void*>(-1);
  }
  char* const begin = end;
  end += increment;
  return begin;
}

int _write(int, const char* text, int size) {
  constexpr std::uint32_t write_character = 0x03;
  for (int i = 0; i < size; ++i) {
    board::ask_host(write_character, text + i);
  }
  return size;
}

int _fstat(int, struct stat* result) {
  result->st_mode = S_IFCHR;
  return 0;
}

// Returns the time since the start of QEMU, in steps of 10 ms.
int _gettimeofday(struct timeval* now, void*) {
  constexpr std::uint32_t clock = 0x10;
  const std::uint32_t hundredths = board::ask_host(clock, nullptr);
  now->tv_sec = hundredths / 100;
  now->tv_usec = static_cast<suseconds_t>(hundredths % 100 * 10000);
  return 0;
}

int _open(const char*, int, ...) { return -1; }
int _isatty(int) { return 1; }
int _read(int, char*, int) { return 0; }
int _close(int) { return -1; }
int _lseek(int, int, int) { return 0; }
int _getpid() { return 1; }
int _kill(int, int) { board::leave(1); }
void _exit(int status) { board::leave(status); }
}
