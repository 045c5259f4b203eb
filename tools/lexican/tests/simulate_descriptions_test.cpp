// SPDX-License-Identifier: Apache-2.0
// Each description of the fixtures, and of the directory LEXICAN_CORPUS, as a simulated device.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "model/types.hpp"
#include "program_bench.hpp"
#include "simulated_devices.hpp"

namespace {

using namespace lexican;
using test::Words;

const std::string project = LEXICAN_TOOL_DIR "/../..";

/// Results of all descriptions.
struct Sum {
  std::size_t descriptions = 0;
  std::size_t started = 0;
  std::vector<std::string> refusals{};
  std::size_t read = 0;      ///< entries with a value
  std::size_t compared = 0;  ///< entries whose value is that of the description
  std::size_t without_data = 0;
  std::size_t left_out = 0;  ///< other entries that are aborted
};

std::vector<std::string> files_below(const std::string& directory) {
  std::vector<std::string> found;
  const std::vector<std::string> endings{".eds", ".dcf", ".xdd", ".xdc", ".xpd", ".xml", ".nxdd", ".nxdc"};
  for (const auto& file : std::filesystem::recursive_directory_iterator(directory)) {
    if (file.is_regular_file() && std::find(endings.begin(), endings.end(), file.path().extension()) != endings.end()) {
      found.push_back(file.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Returns the bytes of a value of the description, as long as \a size; nothing: it has none, or one of unknown form.
std::optional<Bytes> described(const codict::Entry& entry, std::uint8_t node, std::size_t size) {
  const codict::Value& value = codict::value_in_force(entry);
  const codict::DataType& type = codict::data_type(entry.data_type.value);
  Bytes bytes(size);
  const auto copy = [&](const void* from, std::size_t length) {
    std::memcpy(bytes.data(), from, std::min(size, length));
  };
  const auto single = static_cast<float>(value.real);
  const std::uint64_t bits = value.integer_for(node).bits();
  switch (value.kind) {
    case codict::Value::Kind::integer: copy(&bits, sizeof bits); break;
    case codict::Value::Kind::real: size == sizeof single ? copy(&single, size) : copy(&value.real, size); break;
    case codict::Value::Kind::octets: copy(value.octets->data(), value.octets->size()); break;
    case codict::Value::Kind::text:
      if (type.kind != codict::TypeKind::visible_string) {
        return std::nullopt;
      }
      copy(value.text.data(), value.text.size());
      break;
    default: return std::nullopt;
  }
  return bytes;
}

/// Objects whose value the stack itself decides, or that only an application can define.
bool is_of_device(std::uint16_t index) {
  const bool is_structure = index >= 0x1023 && index <= 0x1027;
  return index == 0x1001 || index == 0x1003 || index == 0x1010 || index == 0x1011 || index == 0x1021 ||
         index == 0x13FF || is_structure;
}

/// Returns the described value as the stack changes it: the default SDO server has the COB-IDs of CiA 301, and a PDO
/// that cannot work is switched off, which is named.
Bytes in_force(std::uint16_t index, std::uint8_t sub_index, simulate::Device& device, Bytes bytes) {
  if (index == 0x1200 && (sub_index == 1 || sub_index == 2)) {
    return sub_index == 1 ? Bytes{0x05, 0x06, 0, 0} : Bytes{0x85, 0x05, 0, 0};
  }
  const std::string place = fmt::format("(bit 31 of {:04X}h sub {})", index, sub_index);
  for (const std::string& line : device.dictionary().left_out()) {
    bytes.back() |= static_cast<std::uint8_t>(test::has(line, place) ? 0x80 : 0);
  }
  return bytes;
}

/// Reads all entries of a device.
void walk(SimulatedBus& bus, Sum& sum) {
  const codict::Device& device = *bus.device.description().device();
  codict::for_each_variable(device, [&](std::uint16_t index, std::uint8_t sub_index, const codict::Entry& entry) {
    const bool is_disabled = device.find(index)->node->disabled->value;  // CO_disabled
    if (!codict::is_readable(entry.access.value) || index < 0x1000 || is_disabled) {
      return;
    }
    CAPTURE(describe::key_of(index, sub_index, true));
    const Transfer transfer = bus.client->sdo().upload(index, sub_index, {1 << 20, 1000, {}});
    REQUIRE_MESSAGE(!transfer.is_unanswered(), transfer.outcome());
    REQUIRE(transfer.fault == "");
    if (!transfer.done()) {
      const bool has_data = transfer.code != CO_SDO_ERR_NO_DATA;
      ++(has_data ? sum.left_out : sum.without_data);
      const bool is_left_out = !bus.device.dictionary().left_out().empty() || is_of_device(index);
      CHECK_MESSAGE((is_left_out || !has_data), transfer.outcome());
      return;
    }
    ++sum.read;
    const std::optional<Bytes> bytes = described(entry, 5, transfer.data.size());
    if (bytes && !bytes->empty() && !is_of_device(index)) {
      ++sum.compared;
      CHECK_MESSAGE(transfer.data == in_force(index, sub_index, bus.device, *bytes),
                    bus.device.description().show(index, sub_index, transfer.data)
                        << ", described as " << codict::value_in_force(entry).text);
    }
  });
}

/// Starts the device of a description, and reads it; or notes in one line why it does not start.
void run(const std::string& path, Sum& sum) {
  CAPTURE(path);
  ++sum.descriptions;
  std::string why;
  if (describe::read_description(path, why)) {
    SimulatedBus bus(path);
    why = bus.fault.empty() ? "" : path + ": " + bus.fault;
    if (why.empty()) {
      ++sum.started;
      walk(bus, sum);
      return;
    }
  }
  CHECK(why != "");
  CHECK(why.find('\n') == std::string::npos);
  sum.refusals.push_back(why);
}

void print(const Sum& sum) {
  std::string refusals;
  for (const std::string& refusal : sum.refusals) {
    refusals += "\n  " + refusal;
  }
  MESSAGE(sum.descriptions << " descriptions, " << sum.started << " started, " << sum.refusals.size() << " refused; "
                           << sum.read << " values, " << sum.compared << " of them as described, " << sum.without_data
                           << " without data, " << sum.left_out << " left out" << refusals);
}

}  // namespace

TEST_CASE("simulate: each description of the fixtures starts, and has its values, or is refused in one line") {
  Sum sum;
  for (const char* const directory : {"/tools/lexican/tests/fixtures", "/tools/codict/tests/fixtures", "/demo"}) {
    for (const std::string& path : files_below(project + directory)) {
      run(path, sum);
    }
  }
  print(sum);
  CHECK(sum.started > 60);
  CHECK(sum.compared > 500);
}

TEST_CASE("simulate: each description of real devices starts, and has its values, or is refused in one line" *
          doctest::test_suite("needs LEXICAN_CORPUS, a directory of device descriptions") *
          doctest::skip(std::getenv("LEXICAN_CORPUS") == nullptr)) {
  Sum sum;
  for (const std::string& path : files_below(std::getenv("LEXICAN_CORPUS"))) {
    run(path, sum);
  }
  print(sum);
  CHECK(sum.started > 0);
}

TEST_CASE("lexican dump, apply: the configuration of simulated devices") {
  const struct {
    const char* description;
    std::vector<Words> changes;
    std::vector<Words> set_points{};  // not read, and not written
  } rows[] = {
      {"/demo/clock/generated/clock.eds", {{"1017", "1500"}, {"1800:5", "70"}}},
      {"/tools/lexican/tests/fixtures/device.eds", {{"1017", "1500"}, {"2003", "-1.5"}, {"2005", "axis 2"}}},
      {"/tools/lexican/tests/fixtures/servo.eds",
       {{"6083", "50000"}, {"6065", "3000"}},
       {{"607A", "7531"}, {"60FF", "8642"}}},
      {"/tools/lexican/tests/fixtures/module.eds", {{"6207:1", "3"}}, {{"6411:1", "7531"}}},
      {"/demo/clock/clock.xdd", {{"1017", "1500"}, {"1800:5", "70"}}},
  };
  for (const auto& row : rows) {
    CAPTURE(row.description);
    const std::string path = project + row.description;
    test::Bench bench;
    test::Process sim(bench.line("sim", {path, "--node", "5"}), bench.environment());
    sim.wait_for("node 5");
    const std::string dcf = bench.directory / "5.dcf";
    for (const Words& set_point : row.set_points) {
      const test::Ran write = bench.run("write", {"5", set_point[0], set_point[1], "--eds", path});
      CHECK_MESSAGE(write.status == 0, write.err);
    }
    const test::Ran dump = bench.run("dump", {"5", "-o", dcf, "--eds", path});
    CHECK(dump.status == 0);
    CHECK(!test::has(dump.out, "refused"));
    CHECK(test::has(dump.out, ", set-points") == !row.set_points.empty());
    for (const Words& set_point : row.set_points) {
      CHECK(!test::has(test::bytes_of(dcf), "ParameterValue=" + set_point[1] + "\r\n"));
    }
    const auto differences = [&](const char* option) {
      const test::Ran ran = bench.run("apply", {dcf, option});
      return ran.out.substr(0, ran.out.find(" of ")) + ", status " + std::to_string(ran.status);
    };
    CHECK(differences("--diff") == "0, status 0");
    for (const Words& change : row.changes) {
      const test::Ran write = bench.run("write", {"5", change[0], change[1], "--eds", path});
      CHECK_MESSAGE(write.status == 0, write.err);
    }
    const std::string number = std::to_string(row.changes.size());
    CHECK(differences("--diff") == number + ", status 1");
    CHECK(differences("--yes") == number + ", status 0");
    CHECK(differences("--diff") == "0, status 0");
  }
}
