// SPDX-License-Identifier: Apache-2.0
#include "xdd_dump.hpp"

#include <algorithm>

namespace lexican::codict {

namespace {

class Dump {
 public:
  std::string lines;

  void text(const std::string& name, const Text& text) {
    if (!text.is_empty()) {
      line(name, text.text);
    }
  }
  void line(const std::string& name, const std::string& value) { lines += path_ + name + ": " + value + "\n"; }
  template <typename T>
  void number(const std::string& name, const Field<T>& field) {
    if (field.is_given && !field.is_empty()) {
      line(name, std::to_string(static_cast<std::uint64_t>(field.value)));
    }
  }
  void value(const std::string& name, const Value& value) {
    if (value.is_given) {
      line(name, value.text + " (" + std::to_string(static_cast<int>(value.kind)) + ")");
    }
  }
  template <typename Call>
  void in(const std::string& name, const Call& call) {
    const std::size_t size = path_.size();
    path_ += name + "/";
    call();
    path_.resize(size);
  }

  void labels(const std::string& name, const std::vector<Label>& labels) {
    for (const Label& label : labels) {
      line(name, label.language + "|" + label.text.text + "|" + *label.dictionary + "|" + *label.uri);
    }
  }
  void words(const LabelGroup& words) {
    labels("label", words.labels);
    labels("description", words.descriptions);
  }
  void kept(const std::vector<OpaquePart>& others) {
    std::vector<std::string> each;
    for (const OpaquePart& other : others) {
      Dump inner;
      inner.path_ = path_ + "kept " + other.name + "/";
      inner.text("", other.text);
      inner.kept(other.children);
      each.push_back(inner.lines);
    }
    std::sort(each.begin(), each.end());
    for (const std::string& one : each) {
      lines += one;
    }
  }
  void type(const TypeUse& type) {
    text("type", type.iec);
    text("type reference", type.reference);
  }
  void allowed(const Allowed& allowed, bool is_in_limits) {
    for (const AllowedValue& one : allowed.values) {
      in("allowed", [&] {
        value("value", one.value);
        words(one.texts);
        text("offset", one.offset);
        text("multiplier", one.multiplier);
      });
    }
    for (const Range& range : allowed.ranges) {
      if (is_in_limits) {
        continue;
      }
      in("range", [&] {
        value("minimum", range.minimum);
        value("maximum", range.maximum);
        value("step", range.step);
      });
    }
    text("template of allowed", allowed.template_id);
  }
  void node(const NodeProperties& node) {
    number("disabled", *node.disabled);
    text("count label", node.count_label);
    if (node.storage_group.is_given) {
      line("storage group", node.storage_group.value);
    }
    number("srdo", *node.srdo);
    number("string length", *node.string_length_min);
    number("byte length", *node.byte_length);
    number("extension", *node.extension_io);
    number("flags pdo", *node.flags_pdo);
  }
  void entry(const Entry& entry) {
    text("name", entry.name);
    line("code", std::string(name_of(entry.object_code.value)));
    line("data type", std::to_string(entry.data_type.value));
    line("access", std::string(name_of(entry.access.value)));
    line("pdo", std::string(name_of(entry.pdo_mapping.value)));
    value("default", entry.default_value);
    value("actual", entry.actual_value);
    value("substitute", entry.substitute_value);
    value("low", entry.low_limit);
    value("high", entry.high_limit);
    number("flags", *entry.flags);
    text("denotation", entry.denotation);
    text("id", entry.parameter_id);
    words(entry.texts);
    in("denotations", [&] { words(entry.denotations); });
    if (entry.parameter_id->is_given) {
      type(entry.type);
    }
    in("unit", [&] {
      words(entry.unit->texts);
      text("multiplier", entry.unit->multiplier);
      text("uri", entry.unit->uri);
    });
    const auto& ranges = entry.allowed->ranges;
    const bool is_in_limits = ranges.size() == 1 && ranges[0].minimum.text == entry.low_limit->text &&
                              ranges[0].maximum.text == entry.high_limit->text && !ranges[0].step->is_given;
    allowed(entry.allowed, is_in_limits);
    text("access list", entry.access_list);
    text("support", entry.support);
    for (const Text& support : *entry.conditional_support) {
      text("conditional support", support);
    }
    number("persistent", *entry.persistent);
    text("offset", entry.offset);
    text("multiplier", entry.multiplier);
    text("template", entry.template_id);
    node(entry.node);
    for (const Property& property : *entry.properties) {
      line("property " + property.name, property.value.text);
    }
    kept(entry.others);
  }
  void object(const Object& object) {
    in(std::to_string(object.index), [&] {
      entry(object);
      number("sub number", object.sub_number);
      for (const Sub& sub : object.subs) {
        in(std::to_string(sub.sub_index), [&] { entry(sub); });
      }
    });
  }
  void header(const ProfileHeader& header) {
    for (const Text* one :
         {&header.identification, &header.revision, &header.name, &header.source, &header.class_id, &header.date}) {
      line("header", one->text);
    }
    kept(header.others);
  }
  void group(const Group& group) {
    in("group " + group.id.text, [&] {
      words(group.texts);
      text("access", group.kind_of_access);
      for (const Text& parameter : group.parameters) {
        text("parameter", parameter);
      }
      for (const Group& inner : group.groups) {
        this->group(inner);
      }
      kept(group.others);
    });
  }
  void definition(const TypeDefinition& definition) {
    in("type " + definition.id.text, [&] {
      line("kind", std::to_string(static_cast<int>(definition.kind)));
      text("name", definition.name);
      words(definition.texts);
      type(definition.type);
      text("size", definition.size);
      for (const auto& bounds : definition.bounds) {
        line("bounds", bounds.lower.text + ".." + bounds.upper.text);
      }
      for (const auto& member : definition.members) {
        in("member", [&] {
          text("name", member.name);
          text("id", member.id);
          words(member.texts);
          type(member.type);
          text("size", member.size);
          kept(member.others);
        });
      }
      for (const AllowedValue& one : definition.values) {
        value("value", one.value);
        words(one.texts);
      }
      kept(definition.others);
    });
  }

 private:
  std::string path_;
};

void dump_file(Dump& out, const FileInfo& file) {
  for (const Text* text :
       {&file.file_name, static_cast<const Text*>(&file.version), static_cast<const Text*>(&file.revision),
        &file.eds_version, &file.description, &file.created_by, &file.creation_date, &file.creation_time,
        &file.modified_by, &file.modification_date, &file.modification_time, &file.supported_languages,
        &file.device_class}) {
    out.line("file", text->text);
  }
}

void dump_identity(Dump& out, const Identity& identity) {
  for (const Text* text :
       {&identity.vendor_name, static_cast<const Text*>(&identity.vendor_number), &identity.product_family,
        &identity.product_name, static_cast<const Text*>(&identity.product_number),
        static_cast<const Text*>(&identity.revision_number), &identity.build_date, &identity.specification_revision,
        &identity.instance_name}) {
    out.line("identity", text->text);
  }
  for (const LabelGroup* words : {&identity.vendor_texts, &identity.family_texts, &identity.product_texts}) {
    out.in("identity", [&] { out.words(*words); });
  }
  for (const Text& code : identity.order_codes) {
    out.line("order", code.text);
  }
  for (const Version& version : identity.versions) {
    out.line("version " + version.type.text, version.text.text);
  }
}

void dump_network(Dump& out, const Device& device) {
  const Features& f = device.features;
  for (const BitRate& rate : f.bit_rates) {
    out.line("bit rate", std::to_string(rate.kbit) + (rate.supported.value ? " yes" : " no"));
  }
  out.number("default rate", f.default_bit_rate);
  for (const Field<bool>* flag : {&f.boot_up_master, &f.boot_up_slave, &f.group_messaging, &f.lss_slave, &f.lss_master,
                                  &f.node_guarding_slave, &f.node_guarding_master, &f.self_starting, &f.sdo_requesting,
                                  &f.flying_master, &f.sdo_manager, &f.configuration_manager}) {
    out.line("feature", flag->is_given ? (flag->value ? "yes" : "no") : "");
  }
  out.line("granularity", std::to_string(f.granularity.value));
  out.number("channels", f.dynamic_channels);
  out.number("rx", f.rx_pdos);
  out.number("tx", f.tx_pdos);
  out.number("guarded", f.guarded_nodes);
  const Commissioning& c = device.commissioning;
  out.number("node", c.node_id);
  out.text("node name", c.node_name);
  out.number("rate", c.bit_rate);
  out.number("net", c.network_number);
  out.text("net name", c.network_name);
  out.number("manager", c.is_manager);
  for (const Dummy& dummy : device.dummies) {
    out.line("dummy", std::to_string(dummy.type) + (dummy.supported.value ? " yes" : " no"));
  }
  for (const DynamicChannel& channel : device.dynamic_channels) {
    out.in("channel", [&] {
      out.number("type", channel.data_type);
      out.number("access", channel.access);
      out.number("first", channel.first_index);
      out.number("last", channel.last_index);
      out.number("most", channel.max_number);
      out.number("offset", channel.offset);
      out.number("alignment", channel.bit_alignment);
      out.kept(channel.others);
    });
  }
}

}  // namespace

std::string dump(const Device& device) {
  Dump out;
  dump_file(out, device.file);
  out.header(device.device_profile);
  out.header(device.communication_profile);
  dump_identity(out, device.identity);
  dump_network(out, device);
  for (const Object& object : device.objects) {
    out.object(object);
  }
  for (const TypeDefinition& definition : device.types) {
    out.definition(definition);
  }
  for (const Entry& entry : device.parameters) {
    out.in("parameter", [&] { out.entry(entry); });
  }
  for (const Entry& entry : device.templates) {
    out.in("template", [&] { out.entry(entry); });
  }
  for (const AllowedTemplate& one : device.allowed_templates) {
    out.in("allowed template", [&] {
      out.text("id", one.id);
      out.allowed(one.allowed, false);
    });
  }
  for (const Group& group : device.groups) {
    out.group(group);
  }
  out.kept(device.others);
  return out.lines;
}

}  // namespace lexican::codict
