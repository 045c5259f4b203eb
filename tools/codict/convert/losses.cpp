// SPDX-License-Identifier: Apache-2.0
#include "convert/losses.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace lexican::codict::convert {

namespace {

using Entries = std::vector<const Entry*>;

Entries entries_of(const Device& device) {
  Entries entries;
  for (const Object& object : device.objects) {
    entries.push_back(&object);
    for (const Sub& sub : object.subs) {
      entries.push_back(&sub);
    }
  }
  return entries;
}

class Counter {
 public:
  explicit Counter(const Device& device) : entries_(entries_of(device)) {}

  void add(std::string_view what, std::size_t count) {
    if (count != 0) {
      losses_.push_back({what, count});
    }
  }
  // Of each object and sub-object.
  void each(std::string_view what, const std::function<std::size_t(const Entry&)>& count) {
    std::size_t sum = 0;
    for (const Entry* entry : entries_) {
      sum += count(*entry);
    }
    add(what, sum);
  }
  std::vector<Loss> take() { return std::move(losses_); }

 private:
  Entries entries_;
  std::vector<Loss> losses_;
};

std::size_t one_if(bool is_there) { return is_there ? 1 : 0; }
std::size_t number_of(const Text& text) { return one_if(!text.is_empty()); }

void count_configuration(const Device& device, Counter& counter) {
  counter.each("configured values", [](const Entry& entry) { return one_if(entry.actual_value.is_given); });
  counter.each("denotations", [](const Entry& entry) { return one_if(entry.denotation.is_given); });
  counter.add("commissioning", one_if(device.commissioning.is_given));
}

// An EDS has one name for each object, and nothing else to say of it in words.
void count_for_eds(const Device& device, Counter& counter) {
  counter.each("labels", [](const Entry& entry) {
    const std::vector<Label>& labels = entry.words.labels;
    return static_cast<std::size_t>(std::count_if(
        labels.begin(), labels.end(), [&entry](const Label& label) { return label.text.text != entry.name.text; }));
  });
  const bool has_python_keys = device.dialect == "python-canopen";
  if (!has_python_keys) {
    counter.each("descriptions", [](const Entry& entry) { return entry.words.descriptions.size(); });
    counter.each("units", [](const Entry& entry) { return one_if(entry.unit.is_given); });
    counter.each("multipliers", [](const Entry& entry) { return number_of(entry.multiplier); });
  }
  counter.each("offsets", [](const Entry& entry) { return number_of(entry.offset); });
  counter.each("allowed values", [](const Entry& entry) { return entry.allowed.values.size(); });
  counter.each("substitute values", [](const Entry& entry) { return one_if(entry.substitute_value.is_given); });
  counter.each("properties", [](const Entry& entry) {
    const NodeProperties& node = entry.node;
    return entry.properties.size() + one_if(node.disabled.is_given) + number_of(node.count_label) +
           one_if(node.srdo.is_given) + one_if(node.string_length_min.is_given) + one_if(node.byte_length.is_given) +
           one_if(node.extension_io.is_given) + one_if(node.flags_pdo.is_given);
  });
  counter.add("groups", device.groups.size());
  counter.add("data types", device.types.size());
  counter.add("templates", device.templates.size() + device.allowed_templates.size());
  counter.add("parameters without an object", device.parameters.size());
  counter.add("order codes", device.identity.order_codes.size() > 1 ? device.identity.order_codes.size() - 1 : 0);
  counter.add("versions", device.identity.versions.size());
}

void count_for_xdd(const Device& device, Counter& counter) {
  counter.add("lines of comment", device.comments.size());
  counter.add("modules", device.modules.size());
  counter.add("connected modules", device.connected_modules.size());
  counter.add("sections that CiA 306 does not know", device.others.size());
  counter.each("keys that CiA 306 does not know", [](const Entry& entry) { return entry.others.size(); });
  counter.each("files of domains",
               [](const Entry& entry) { return number_of(entry.upload_file) + number_of(entry.download_file); });
  std::size_t links = 0;
  for (const Object& object : device.objects) {
    links += object.links.size();
  }
  counter.add("object links", links);
}

// Of the commissioning of one device.
void count_for_xdc(const Commissioning& commissioning, Counter& counter) {
  counter.add("serial numbers", number_of(commissioning.serial_number));
  counter.add("references to other files",
              number_of(commissioning.node_reference) + number_of(commissioning.network_reference));
}

bool is_of_eds(const Device& device) { return device.format == Format::eds || device.format == Format::dcf; }

}  // namespace

std::vector<Loss> losses(const Description& description, Target target) {
  const Device& device = description.devices.front();
  Counter counter(device);
  if (target != Target::json) {
    counter.add("further devices", description.devices.size() - 1);
  }
  if (target == Target::eds || target == Target::xdd) {
    count_configuration(device, counter);
  }
  if (target == Target::eds || target == Target::dcf) {
    count_for_eds(device, counter);
  } else if (target != Target::json && is_of_eds(device)) {
    count_for_xdd(device, counter);
    if (target == Target::xdc) {
      count_for_xdc(device.commissioning, counter);
    }
  }
  return counter.take();
}

Device without_configuration(Device device) {
  device.commissioning = Commissioning();
  device.connected_modules.clear();
  const auto forget = [](Entry& entry) {
    entry.actual_value = Value();
    entry.denotation = Text();
  };
  for (Object& object : device.objects) {
    forget(object);
    for (Sub& sub : object.subs) {
      forget(sub);
    }
  }
  return device;
}

}  // namespace lexican::codict::convert
