// SPDX-License-Identifier: Apache-2.0
/// \file json_schema.hpp
/// Checks a JSON value against a definition of docs/schema.json. It implements the keywords that this schema uses, and
/// refuses a schema with others.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace test {

class Schema {
 public:
  using Json = nlohmann::json;

  explicit Schema(Json root) : root_(std::move(root)) {}

  /// Returns the fault of a value; empty: it has none.
  std::string fault_of(const Json& value, const std::string& definition) const {
    return check(value, root_.at("$defs").at(definition), definition);
  }

 private:
  static bool has_type(const Json& value, const std::string& type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "null"    ? value.is_null()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "integer" ? value.is_number_integer()
           : type == "number"  ? value.is_number()
                               : false;
  }

  static bool is_base16(const std::string& text) {
    return text.size() % 2 == 0 && text.find_first_not_of("0123456789ABCDEF") == std::string::npos;
  }

  std::string check(const Json& value, const Json& schema, const std::string& where) const {
    for (const auto& [keyword, argument] : schema.items()) {
      const std::string fault = check_keyword(value, schema, keyword, argument, where);
      if (!fault.empty()) {
        return fault;
      }
    }
    return {};
  }

  std::string check_keyword(const Json& value, const Json& schema, const std::string& keyword, const Json& argument,
                            const std::string& where) const {
    const std::string fault = where + ": " + value.dump() + " violates " + keyword + ' ' + argument.dump();
    const auto unless = [&](bool is_right) { return is_right ? std::string() : fault; };
    if (keyword == "$ref") {
      return check(value, root_.at(Json::json_pointer(argument.get<std::string>().substr(1))), where);
    }
    if (keyword == "type") {
      return unless(has_type(value, argument));
    }
    if (keyword == "enum") {
      return unless(std::find(argument.begin(), argument.end(), value) != argument.end());
    }
    if (keyword == "anyOf") {
      return unless(std::any_of(argument.begin(), argument.end(),
                                [&](const Json& each) { return check(value, each, where).empty(); }));
    }
    if (keyword == "minimum") {
      return unless(!value.is_number() || value >= argument);
    }
    if (keyword == "maximum") {
      return unless(!value.is_number() || value <= argument);
    }
    if (keyword == "minLength") {
      return unless(!value.is_string() || value.get_ref<const std::string&>().size() >= argument);
    }
    if (keyword == "contentEncoding") {
      return unless(argument == "base16" && value.is_string() && is_base16(value));
    }
    if (keyword == "required") {
      return unless(std::all_of(argument.begin(), argument.end(),
                                [&](const Json& name) { return value.contains(name.get<std::string>()); }));
    }
    if (keyword == "properties" || keyword == "additionalProperties") {
      return check_members(value, schema, keyword, argument, where);
    }
    if (keyword == "items") {
      for (const Json& item : value.is_array() ? value : Json::array()) {
        if (std::string wrong = check(item, argument, where + "[]"); !wrong.empty()) {
          return wrong;
        }
      }
      return {};
    }
    return where + ": unknown keyword " + keyword;
  }

  std::string check_members(const Json& value, const Json& schema, const std::string& keyword, const Json& argument,
                            const std::string& where) const {
    static const Json none = Json::object();
    const Json& properties = schema.contains("properties") ? schema.at("properties") : none;
    for (const auto& [name, member] : value.is_object() ? value.items() : none.items()) {
      const bool is_listed = properties.contains(name);
      std::string fault;
      if (keyword == "properties") {
        fault = is_listed ? check(member, argument.at(name), where + '.' + name) : "";
      } else if (!is_listed) {
        fault = argument.is_boolean() ? (argument ? "" : where + ": additional member " + name)
                                      : check(member, argument, where + '.' + name);
      }
      if (!fault.empty()) {
        return fault;
      }
    }
    return {};
  }

  Json root_;
};

}  // namespace test
