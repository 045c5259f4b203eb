// SPDX-License-Identifier: Apache-2.0
// Memory on demand.
#include "model/rare.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "xdd_reading.hpp"

using lexican::codict::Entry;
using lexican::codict::Rare;
using test::XmlReading;

TEST_CASE("rare: a value without memory reads as a default value, and reading allocates nothing") {
  Rare<std::string> rare;
  CHECK(rare->empty());
  CHECK(*rare == std::string());
  CHECK(rare.if_any() == nullptr);
  rare.edit() = "some";
  CHECK(*rare == "some");
  CHECK(rare.if_any() != nullptr);
  rare.reset();
  CHECK(rare->empty());
}

TEST_CASE("rare: a copy is independent, a moved value leaves nothing") {
  Rare<std::string> rare(std::string("some"));
  Rare<std::string> copy(rare);
  copy.edit() = "other";
  CHECK(*rare == "some");
  const Rare<std::string> moved(std::move(copy));
  CHECK(*moved == "other");
  rare = moved;
  CHECK(*rare == "other");
  Rare<std::string>& same = rare;
  rare = same;
  CHECK(*rare == "other");
}

TEST_CASE("XDD: a parameter of several objects describes each of them, and is freed after the last") {
  const XmlReading reading(test::xdd_with(
      R"(<CANopenObject index="2000" name="A" objectType="7" uniqueIDRef="P"/>
<CANopenObject index="2001" name="B" objectType="9" subNumber="2">
<CANopenSubObject subIndex="00" name="Number" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
<CANopenSubObject subIndex="01" name="C" objectType="7" uniqueidref=" P "/>
</CANopenObject>
<CANopenObject index="2001" name="Twice" objectType="7" uniqueIDRef="P"/>
<CANopenObject index="2002" name="D" objectType="7" uniqueIDRef="P"/>)",
      R"(<parameter uniqueID="P" access="readWrite"><label lang="en">Shared</label><UINT/>
<defaultValue value="5"/></parameter>)"));
  for (const Entry* entry : {&reading.at(0x2000), &reading.at(0x2001, 1), &reading.at(0x2002)}) {
    CHECK(text_in(entry->texts->labels, "en") == "Shared");
    CHECK(entry->default_value.text == "5");
  }
  CHECK(reading.device.parameters.empty());
}
