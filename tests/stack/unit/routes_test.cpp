// SPDX-License-Identifier: Apache-2.0
#include "base/routes.hpp"

#include <random>

#include "support/fixture.hpp"

#if CO_ROUTES_SORTED

namespace {

using namespace test;

struct Route {
  std::uint32_t id;
  std::uint8_t receiver;
  std::uint16_t number;
  bool operator<(const Route& other) const { return id < other.id; }
};

// Returns the routes of an identifier in the order of the lookup.
std::vector<Route> found(const CO_NODE& node, std::uint32_t id) {
  std::vector<Route> all;
  for (unsigned n = co::routes::find(node, id); n != co::routes::nowhere && co::routes::is_at(node, n, id); ++n) {
    all.push_back({id, co::routes::receiver_of(node.Routes.Owner[n]), co::routes::number_of(node.Routes.Owner[n])});
  }
  return all;
}

std::uint16_t owner(unsigned receiver, std::uint16_t number) {
  return static_cast<std::uint16_t>(receiver << 12 | number);
}

void add(CO_NODE& node, std::uint32_t id, unsigned receiver, std::uint16_t number) {
  co::routes::add(node, id, owner(receiver, number));
}

void remove(CO_NODE& node, unsigned receiver, std::uint16_t number) {
  co::routes::remove(node, owner(receiver, number));
}

unsigned number_of_routes(const CO_NODE& node) { return node.Routes.Start[CO_ROUTE_CLASS_N]; }

CO_NODE& empty_node() {
  static CO_NODE node;
  co::routes::clear(node);
  return node;
}

TEST_CASE("routes: an empty table has no owner for any identifier") {
  CO_NODE& node = empty_node();
  for (const std::uint32_t id : {0x000U, 0x601U, 0x7FFU, 0x80000601U, 0x9FFFFFFFU}) {
    CHECK(found(node, id).empty());
  }
}

TEST_CASE("routes: 11-bit and 29-bit identifiers of the same number are different") {
  CO_NODE& node = empty_node();
  add(node, 0x123, 1, 0);
  add(node, 0x80000123, 2, 5);
  REQUIRE(found(node, 0x123).size() == 1);
  CHECK(found(node, 0x123)[0].receiver == 1);
  REQUIRE(found(node, 0x80000123).size() == 1);
  CHECK(found(node, 0x80000123)[0].receiver == 2);
  CHECK(found(node, 0x80000123)[0].number == 5);
  CHECK(found(node, 0x122).empty());
}

TEST_CASE("routes: a missing route cannot be removed") {
  CO_NODE& node = empty_node();
  add(node, 0x601, 2, 0);
  remove(node, 2, 1);
  remove(node, 1, 0);
  CHECK(number_of_routes(node) == 1);
  remove(node, 2, 0);
  remove(node, 2, 0);
  CHECK(number_of_routes(node) == 0);
}

TEST_CASE("routes: sorted after any additions and removals, and all equal identifiers are found") {
  std::mt19937 random(42);
  constexpr std::uint32_t ids[] = {0x000, 0x07F, 0x080, 0x601, 0x67F, 0x690, 0x7FF, 0x80000601, 0x9FFFFFFF};
  for (unsigned round = 0; round < 200 / stride(10); ++round) {
    CO_NODE& node = empty_node();
    std::vector<Route> model;
    for (std::uint16_t step = 0; step < 40; ++step) {
      if (model.size() < CO_ROUTE_N && random() % 2 == 0) {
        const Route route{ids[random() % 9], static_cast<std::uint8_t>(random() % 3), step};
        add(node, route.id, route.receiver, route.number);
        model.push_back(route);
      } else if (!model.empty()) {
        const auto victim = model.begin() + static_cast<std::ptrdiff_t>(random() % model.size());
        remove(node, victim->receiver, victim->number);
        model.erase(victim);
      }
      REQUIRE(number_of_routes(node) == model.size());
      for (const std::uint32_t id : ids) {
        const auto number = std::count_if(model.begin(), model.end(), [&](const Route& r) { return r.id == id; });
        CHECK(found(node, id).size() == static_cast<std::size_t>(number));
      }
      CHECK(std::is_sorted(node.Routes.Id, node.Routes.Id + number_of_routes(node)));
    }
  }
}

TEST_CASE("routes: those of an identifier are called once in the order of owners, also if they change routes") {
  CO_NODE& node = empty_node();
  add(node, 0x601, 2, 7);
  add(node, 0x601, 1, 3);
  add(node, 0x601, 1, 1);
  unsigned place = co::routes::find(node, 0x601);
  const std::uint16_t first = node.Routes.Owner[place];
  CHECK(co::routes::number_of(first) == 1);
  remove(node, 1, 1);
  add(node, 0x500, 0, 0);
  add(node, 0x601, 1, 1);
  place = co::routes::next(node, place, 0x601, first);
  REQUIRE(co::routes::is_at(node, place, 0x601));
  const std::uint16_t second = node.Routes.Owner[place];
  CHECK(co::routes::number_of(second) == 3);
  remove(node, 0, 0);
  remove(node, 1, 3);
  place = co::routes::next(node, place, 0x601, second);
  REQUIRE(co::routes::is_at(node, place, 0x601));
  CHECK(co::routes::number_of(node.Routes.Owner[place]) == 7);
  CHECK(co::routes::next(node, place, 0x601, node.Routes.Owner[place]) == co::routes::nowhere);
}

TEST_CASE("routes: a driver with a filter gets the identifiers before it is enabled") {
  Fixture node(Setup().stay_in_init().node_id(9));
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x609, 0x709});
  CHECK(node.can.filter_off_bus);
}

}  // namespace

#endif
