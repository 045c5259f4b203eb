// SPDX-License-Identifier: Apache-2.0
/// \file bench.cpp
/// Measures the readers with the given files, or with a generated EDS of 500 KB and XDD of 4 MB. Prints the best of
/// several runs in milliseconds of CPU time. The times are no criterion of the tests.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <utility>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "large_xdd.hpp"
#include "text/file.hpp"
#include "xdd/document.hpp"
#include "xdd/read.hpp"

namespace {

using namespace lexican::codict;

constexpr int runs = 10;

std::string large_eds(unsigned objects) {
  std::string text = "[FileInfo]\nFileName=large.eds\n[DeviceInfo]\nVendorName=Lexican\n[ManufacturerObjects]\n";
  text += fmt::format("SupportedObjects={}\n", objects);
  for (unsigned n = 0; n < objects; ++n) {
    text += fmt::format("{}=0x{:04X}\n", n + 1, 0x2000 + n);
  }
  for (unsigned n = 0; n < objects; ++n) {
    text += fmt::format(
        "[{:04X}]\nParameterName=Parameter number {}\nObjectType=0x7\nDataType=0x0006\nLowLimit=0\nHighLimit=0xFFF\n"
        "AccessType=rw\nDefaultValue=0x{:X}\nPDOMapping=1\n\n",
        0x2000 + n, n, n & 0xFFFU);
  }
  return text;
}

void read_xml(Source source) {
  Findings findings;
  xdd::Document document(std::move(source), findings);
  const Description description = xdd::read(document, findings);
  if (description.devices.empty()) {
    std::abort();
  }
}

void read_eds(Source source) {
  Findings findings;
  const eds::Document document(std::move(source), findings);
  const Description description = eds::read(document, findings);
  if (description.devices.empty()) {
    std::abort();
  }
}

void measure(const Source& source) {
  const bool is_xml = source.bytes().substr(0, 200).find('<') != std::string_view::npos;
  double best = 1e9;
  for (int n = 0; n < runs; ++n) {
    Source copy = source;
    const std::clock_t begin = std::clock();
    is_xml ? read_xml(std::move(copy)) : read_eds(std::move(copy));
    best = std::min(best, static_cast<double>(std::clock() - begin) * 1000 / CLOCKS_PER_SEC);
  }
  fmt::print("{:8.1f} ms {:8} bytes  {}\n", best, source.size(), source.name());
}

}  // namespace

int main(int count, char** arguments) {
  measure(Source("large.eds", large_eds(3500)));
  measure(Source("large.xdd", test::large_xdd(test::Large::objects, 4147000)));
  for (int n = 1; n < count; ++n) {
    std::string why;
    if (const std::optional<Source> source = read_file(arguments[n], why)) {
      measure(*source);
    }
  }
}
