// SPDX-License-Identifier: Apache-2.0
#include "model/subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace lexican::codict {

namespace {

std::string with_name(const std::string& subject, const Text& name) {
  return name.text.empty() ? subject : subject + " " + in_quotes(name.text);
}

std::string subject_of_sub(std::uint16_t index, const Sub& sub) {
  return with_name(fmt::format("{:04X}h:{:02X}", index, sub.sub_index), sub.name);
}

// The span of an entry in the source. Spans of one kind do not overlap.
struct Extent {
  Span span;
  const Entry* entry;
  const Object* object;  // null for a parameter without an object
  bool is_sub;

  std::string subject() const {
    return object == nullptr ? with_name("parameter", entry->parameter_id)
           : is_sub          ? subject_of_sub(object->index, static_cast<const Sub&>(*entry))
                             : codict::subject_of(*object);
  }
};

class Extents {
 public:
  explicit Extents(const Device& device) {
    for (const Object& object : device.objects) {
      add(object);
    }
    for (const Module& module : device.modules) {
      for (const Object& object : module.fixed) {
        add(object);
      }
      for (const SubExtension& extension : module.extensions) {
        add(extension.object);
      }
    }
    for (const Entry& parameter : device.parameters) {
      add(parameters_, {parameter.parameter_extent, &parameter, nullptr, false});
    }
    for (std::vector<Extent>* all : {&subs_, &parameters_, &objects_}) {
      std::stable_sort(all->begin(), all->end(),
                       [](const Extent& a, const Extent& b) { return a.span.begin < b.span.begin; });
    }
  }

  // Returns the innermost extent that contains a place; null if it is in no object.
  const Extent* find(std::uint32_t place) const {
    const Extent* const sub = find(subs_, place);
    const Extent* const parameter = sub == nullptr ? find(parameters_, place) : sub;
    return parameter == nullptr ? find(objects_, place) : parameter;
  }

 private:
  static void add(std::vector<Extent>& all, const Extent& extent) {
    if (!extent.span.is_empty()) {
      all.push_back(extent);
    }
  }
  void add(const Object& object) {
    add(objects_, {object.extent, &object, &object, false});
    add(parameters_, {object.parameter_extent, &object, &object, false});
    for (const Sub& sub : object.subs) {
      add(subs_, {sub.extent, &sub, &object, true});
      add(parameters_, {sub.parameter_extent, &sub, &object, true});
    }
  }
  static const Extent* find(const std::vector<Extent>& all, std::uint32_t place) {
    const auto behind = std::upper_bound(all.begin(), all.end(), place,
                                         [](std::uint32_t at, const Extent& extent) { return at < extent.span.begin; });
    const bool is_inside = behind != all.begin() && place <= std::prev(behind)->span.end;
    return is_inside ? &*std::prev(behind) : nullptr;
  }

  std::vector<Extent> objects_;
  std::vector<Extent> subs_;
  std::vector<Extent> parameters_;
};

}  // namespace

std::string subject_of(const Object& object) { return with_name(fmt::format("{:04X}h", object.index), object.name); }

std::string subject_of(const Device& device, std::uint16_t index, std::uint8_t sub_index) {
  const Object* const object = device.find(index);
  const Sub* const sub = object != nullptr ? object->find(sub_index) : nullptr;
  const bool is_variable = sub_index == 0 && (object == nullptr || object->subs.empty());
  return sub != nullptr      ? subject_of_sub(index, *sub)
         : !is_variable      ? fmt::format("{:04X}h:{:02X}", index, sub_index)
         : object != nullptr ? subject_of(*object)
                             : fmt::format("{:04X}h", index);
}

std::string text_of(const Value& value) {
  return value.text.empty() && value.is_integer() ? value.written_integer() : shortened(value.text);
}

std::string type_text(std::uint16_t code) {
  const std::string_view name = data_type(code).name;
  return name.empty() ? fmt::format("{:04X}h", code) : std::string(name);
}

void name_subjects(const Device& device, Findings& findings) {
  if (findings.all().empty()) {
    return;
  }
  const Extents extents(device);
  findings.for_each([&extents](Finding& finding) {
    const bool has_place = !(finding.span == Span{});
    if (const Extent* const extent = has_place ? extents.find(finding.span.begin) : nullptr) {
      finding.subject = extent->subject();
    }
  });
}

}  // namespace lexican::codict
