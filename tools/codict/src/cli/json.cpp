// SPDX-License-Identifier: Apache-2.0
#include "cli/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lexican::codict::cli {

namespace {

using Tree = nlohmann::ordered_json;

// Converts to the type of the library, which prints it.
Tree tree_of(const Json& json) {
  switch (json.kind()) {
    case Json::Kind::boolean: return json.boolean();
    case Json::Kind::integer:
      return json.is_signed() ? Tree(static_cast<std::int64_t>(json.number())) : Tree(json.number());
    case Json::Kind::string: return json.text();
    case Json::Kind::array: {
      Tree tree = Tree::array();
      for (const Json& element : json.elements()) {
        tree.push_back(tree_of(element));
      }
      return tree;
    }
    case Json::Kind::object: {
      Tree tree = Tree::object();
      for (const Json::Member& member : json.members()) {
        tree.emplace(member.name, tree_of(member.value));
      }
      return tree;
    }
    case Json::Kind::null: break;
  }
  return nullptr;
}

}  // namespace

Json::Json(std::initializer_list<Member> members) : kind_(Kind::object), members_(members) {}

Json Json::array(std::initializer_list<Json> elements) {
  Json json;
  json.kind_ = Kind::array;
  json.elements_ = elements;
  return json;
}

Json Json::object() {
  Json json;
  json.kind_ = Kind::object;
  return json;
}

void Json::push_back(Json element) {
  kind_ = Kind::array;
  elements_.push_back(std::move(element));
}

Json& Json::operator[](std::string_view name) {
  kind_ = Kind::object;
  const auto place =
      std::find_if(members_.begin(), members_.end(), [name](const Member& member) { return member.name == name; });
  if (place != members_.end()) {
    return place->value;
  }
  members_.push_back({std::string(name), Json()});
  return members_.back().value;
}

std::string Json::dump(int indentation) const {
  return tree_of(*this).dump(indentation, ' ', false, Tree::error_handler_t::replace);
}

}  // namespace lexican::codict::cli
