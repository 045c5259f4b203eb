// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mutants.hpp"

namespace check {
namespace {

constexpr std::uint32_t page = 64;

CO_IF_NVM_DRV spoilt = {};

std::function<void(Setting&)> with(const std::function<void(CO_IF_NVM_DRV&)>& spoil) {
  return [spoil](Setting& s) {
    spoilt = PlainNvmDriver;
    spoil(spoilt);
    s.plain.Nvm = &spoilt;
  };
}

std::uint32_t write(std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
  return PlainNvmDriver.Write(start, from, size);
}

// Writes to an EEPROM without regard to pages: a write beyond the end of a page continues at its beginning.
std::uint32_t write_in_page(std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
  for (std::uint32_t n = 0; n < size; ++n) {
    write(start / page * page + (start + n) % page, from + n, 1);
  }
  return size;
}

std::vector<Mutant> plain_mutants() {
  return {
      {"Write has no effect", "nvm.whole",
       with([](auto& m) { m.Write = [](std::uint32_t, std::uint8_t*, std::uint32_t size) { return size; }; })},
      {"the last byte is not written", "nvm.whole", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           return start + size == plain_nvm_size ? write(start, from, size - 1) + 1 : write(start, from, size);
         };
       })},
      {"the last byte cannot be written", "nvm.whole", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           return start + size == plain_nvm_size ? write(start, from, size - 1) : write(start, from, size);
         };
       })},
      {"an address line is open", "nvm.whole", with([](auto& m) {
         m.Read = [](std::uint32_t start, std::uint8_t* to, std::uint32_t size) {
           return PlainNvmDriver.Read(start & ~0x100U, to, size);
         };
       })},
      {"a page is full", "nvm.whole", with([](auto& m) { m.Write = write_in_page; })},
      {"old bits stay, as in flash that was not erased", "nvm.whole", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           for (std::uint32_t n = 0; n < size; ++n) {
             std::uint8_t byte = 0;
             PlainNvmDriver.Read(start + n, &byte, 1);
             byte &= from[n];
             write(start + n, &byte, 1);
           }
           return size;
         };
       })},
      {"Read is of whole words", "nvm.read", with([](auto& m) {
         m.Read = [](std::uint32_t start, std::uint8_t* to, std::uint32_t size) {
           return PlainNvmDriver.Read(start & ~3U, to, size);
         };
       })},
      {"Read fills a byte too many", "nvm.read", with([](auto& m) {
         m.Read = [](std::uint32_t start, std::uint8_t* to, std::uint32_t size) {
           to[size] = size % 2 == 1 ? 0 : to[size];
           return PlainNvmDriver.Read(start, to, size);
         };
       })},
      {"Init erases", "nvm.kept", with([](auto& m) {
         m.Init = [] {
           std::uint8_t erased[plain_nvm_size];
           std::fill(std::begin(erased), std::end(erased), std::uint8_t{0xFF});
           write(0, erased, plain_nvm_size);
         };
       })},
      {"Write is of whole words", "nvm.write", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           std::uint8_t padding[4] = {0xFF, 0xFF, 0xFF, 0xFF};
           write(start, from, size);
           write(start + size, padding, std::min((4 - (start + size) % 4) % 4, plain_nvm_size - start - size));
           return size;
         };
       })},
      {"Write uses the bytes of its caller", "nvm.buffer", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           const std::uint32_t done = write(start, from, size);
           std::fill_n(from, size, std::uint8_t{0});
           return done;
         };
       })},
      {"Write beyond the end is reported as done", "nvm.overflow", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           write(start, from, size);
           return size;
         };
       })},
      {"Read beyond the end is reported as done", "nvm.overflow", with([](auto& m) {
         m.Read = [](std::uint32_t start, std::uint8_t* to, std::uint32_t size) {
           PlainNvmDriver.Read(start, to, size);
           return size;
         };
       })},
      {"Write beyond the end begins anew", "nvm.overflow", with([](auto& m) {
         m.Write = [](std::uint32_t start, std::uint8_t* from, std::uint32_t size) {
           return start >= plain_nvm_size ? write(0, from, size) - 1 : write(start, from, size);
         };
       })},
  };
}

CO_IF_NVM_DRV_EX spoilt_flash = {};
Flash memory;

std::function<void(Setting&)> with_flash(const std::function<void(CO_IF_NVM_DRV_EX&)>& spoil) {
  return [spoil](Setting& s) {
    memory = {};
    spoilt_flash = FlashDriver;
    spoil(spoilt_flash);
    s.ext.Nvm = &spoilt_flash;
    s.ext.NvmCtx = &memory;
  };
}

std::vector<Mutant> flash_mutants() {
  return {
      {"the capacity is no multiple", "nvm.shape", with_flash([](auto& m) {
         m.Shape = [](void*) { return CO_NVM_SHAPE{4000, 8, 512}; };
       })},
      {"the program size is 0", "nvm.shape", with_flash([](auto& m) {
         m.Shape = [](void*) { return CO_NVM_SHAPE{4096, 0, 512}; };
       })},
      {"flash without Erase", "nvm.shape", with_flash([](auto& m) { m.Erase = nullptr; })},
      {"one unit alone", "nvm.shape", with_flash([](auto& m) {
         m.Shape = [](void*) { return CO_NVM_SHAPE{4096, 8, 4096}; };
       })},
      {"the capacity is too large by a unit", "nvm.whole", with_flash([](auto& m) {
         m.Shape = [](void*) { return CO_NVM_SHAPE{4608, 8, 512}; };
       })},
      {"Erase has no effect", "nvm.whole",
       with_flash([](auto& m) { m.Erase = [](void*, std::uint32_t, std::uint32_t) { return true; }; })},
      {"the last word of a page is not programmed", "nvm.whole", with_flash([](auto& m) {
         m.Write = [](void* ctx, std::uint32_t start, const std::uint8_t* from, std::uint32_t size) {
           const bool last = (start + size) % 512 == 0;
           return last ? FlashDriver.Write(ctx, start, from, size - 8) + 8 : FlashDriver.Write(ctx, start, from, size);
         };
       })},
      {"programs a word too many", "nvm.write", with_flash([](auto& m) {
         m.Write = [](void* ctx, std::uint32_t start, const std::uint8_t* from, std::uint32_t size) {
           const std::uint8_t zero[8] = {};
           const std::uint32_t done = FlashDriver.Write(ctx, start, from, size);
           if (size < 64) {
             FlashDriver.Write(ctx, start + size, zero, 8);
           }
           return done;
         };
       })},
      {"Erase takes the unit before, too", "nvm.erase", with_flash([](auto& m) {
         m.Erase = [](void* ctx, std::uint32_t start, std::uint32_t size) {
           const std::uint32_t more = start == 0 ? 0 : 512;
           return FlashDriver.Erase(ctx, start - more, size + more);
         };
       })},
      {"erased memory is 00h", "nvm.erase", with_flash([](auto& m) {
         m.Erase = [](void* ctx, std::uint32_t start, std::uint32_t size) {
           const bool done = FlashDriver.Erase(ctx, start, size);
           if (done && start != 0) {
             std::fill_n(memory.bytes.begin() + start, size, std::uint8_t{0});
           }
           return done;
         };
       })},
      {"an erase beyond the end is reported as done", "nvm.erase", with_flash([](auto& m) {
         m.Erase = [](void* ctx, std::uint32_t start, std::uint32_t size) {
           FlashDriver.Erase(ctx, start, size);
           return true;
         };
       })},
  };
}

}  // namespace

std::vector<Mutant> nvm_mutants() {
  std::vector<Mutant> all = plain_mutants();
  const std::vector<Mutant> more = flash_mutants();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace check
