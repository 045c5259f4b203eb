// SPDX-License-Identifier: Apache-2.0
/// \file members.hpp
/// Schema codict-device-1: for each part of the model, a list of its members, which both reader and writer use. Names
/// of members never change.
#pragma once

#include <string_view>
#include <type_traits>

#include "model/device.hpp"

namespace lexican::codict::json {

constexpr std::string_view schema = "codict-device-1";

/// A part of the model as a visitor accesses it: const, except for the reader.
template <typename Visit, typename T>
using Part = std::conditional_t<Visit::is_reading, T, const T>;

// The functions call visit(name, member), or visit.required(name, number) for a member that identifies the part.
// visit.end_of(part) follows the members of an entry and of the device. At the end of the device the reader interprets
// the values, because all data types are known then.

template <typename Visit>
void members(Visit& visit, Part<Visit, OpaquePart>& part) {
  visit("name", part.name);
  visit("text", part.text);
  visit("children", part.children);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Label>& label) {
  visit("language", label.language);
  visit("text", label.text);
  visit("dictionary", label.dictionary);
  visit("uri", label.uri);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, LabelGroup>& texts) {
  visit("labels", texts.labels);
  visit("descriptions", texts.descriptions);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Unit>& unit) {
  visit("given", unit.is_given);
  visit("words", unit.texts);
  visit("multiplier", unit.multiplier);
  visit("uri", unit.uri);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, AllowedValue>& allowed) {
  visit("value", allowed.value);
  visit("words", allowed.texts);
  visit("offset", allowed.offset);
  visit("multiplier", allowed.multiplier);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Range>& range) {
  visit("minimum", range.minimum);
  visit("maximum", range.maximum);
  visit("step", range.step);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Allowed>& allowed) {
  visit("values", allowed.values);
  visit("ranges", allowed.ranges);
  visit("template_id", allowed.template_id);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, AllowedTemplate>& allowed) {
  visit("id", allowed.id);
  visit("allowed", allowed.allowed);
}

// Data types -------------------------------------------------------------------------------------------------------

template <typename Visit>
void members(Visit& visit, Part<Visit, TypeUse>& type) {
  visit("iec", type.iec);
  visit("reference", type.reference);
  visit("code", type.code);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, TypeDefinition::Bounds>& bounds) {
  visit("lower", bounds.lower);
  visit("upper", bounds.upper);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, TypeDefinition::Member>& member) {
  visit("name", member.name);
  visit("id", member.id);
  visit("words", member.texts);
  visit("type", member.type);
  visit("size", member.size);
  visit("others", member.others);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, TypeDefinition>& type) {
  visit.required("kind", type.kind);
  visit("name", type.name);
  visit("id", type.id);
  visit("words", type.texts);
  visit("type", type.type);
  visit("size", type.size);
  visit("bounds", type.bounds);
  visit("members", type.members);
  visit("values", type.values);
  visit("others", type.others);
}

// Objects ----------------------------------------------------------------------------------------------------------

template <typename Visit>
void members(Visit& visit, Part<Visit, NodeProperties>& node) {
  visit("disabled", node.disabled);
  visit("count_label", node.count_label);
  visit("storage_group", node.storage_group);
  visit("srdo", node.srdo);
  visit("string_length_min", node.string_length_min);
  visit("byte_length", node.byte_length);
  visit("extension_io", node.extension_io);
  visit("flags_pdo", node.flags_pdo);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Property>& property) {
  visit("name", property.name);
  visit("value", property.value);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Entry>& entry) {
  visit("name", entry.name);
  visit("object_code", entry.object_code);
  visit("data_type", entry.data_type);
  visit("access", entry.access);
  visit("pdo_mapping", entry.pdo_mapping);
  visit("default_value", entry.default_value);
  visit("actual_value", entry.actual_value);
  visit("substitute_value", entry.substitute_value);
  visit("low_limit", entry.low_limit);
  visit("high_limit", entry.high_limit);
  visit("flags", entry.flags);
  visit("denotation", entry.denotation);
  visit("upload_file", entry.upload_file);
  visit("download_file", entry.download_file);
  visit("parameter_reference", entry.parameter_reference);
  visit("parameter_id", entry.parameter_id);
  visit("words", entry.texts);
  visit("denotations", entry.denotations);
  visit("type", entry.type);
  visit("unit", entry.unit);
  visit("allowed", entry.allowed);
  visit("access_list", entry.access_list);
  visit("support", entry.support);
  visit("conditional_support", entry.conditional_support);
  visit("persistent", entry.persistent);
  visit("offset", entry.offset);
  visit("multiplier", entry.multiplier);
  visit("template_id", entry.template_id);
  visit("node", entry.node);
  visit("properties", entry.properties);
  visit("others", entry.others);
  visit.end_of(entry);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Sub>& sub) {
  visit.required("sub_index", sub.sub_index);
  visit("implied", sub.is_implied);
  members(visit, static_cast<Part<Visit, Entry>&>(sub));
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Object>& object) {
  visit.required("index", object.index);
  members(visit, static_cast<Part<Visit, Entry>&>(object));
  visit("sub_number", object.sub_number);
  visit("compact", object.compact);
  visit("links", object.links);
  visit("listed", object.is_listed);
  visit("subs", object.subs);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, ObjectList>& list) {
  visit("given", list.is_given);
  visit("count", list.count);
  visit("indexes", list.indexes);
}

// Device -----------------------------------------------------------------------------------------------------------

template <typename Visit>
void members(Visit& visit, Part<Visit, FileInfo>& file) {
  visit("file_name", file.file_name);
  visit("version", file.version);
  visit("revision", file.revision);
  visit("eds_version", file.eds_version);
  visit("description", file.description);
  visit("created_by", file.created_by);
  visit("creation_date", file.creation_date);
  visit("creation_time", file.creation_time);
  visit("modified_by", file.modified_by);
  visit("modification_date", file.modification_date);
  visit("modification_time", file.modification_time);
  visit("last_eds", file.last_eds);
  visit("supported_languages", file.supported_languages);
  visit("device_class", file.device_class);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, ProfileHeader>& header) {
  visit("identification", header.identification);
  visit("revision", header.revision);
  visit("name", header.name);
  visit("source", header.source);
  visit("class_id", header.class_id);
  visit("date", header.date);
  visit("others", header.others);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Version>& version) {
  visit("type", version.type);
  visit("text", version.text);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Identity>& identity) {
  visit("vendor_name", identity.vendor_name);
  visit("vendor_number", identity.vendor_number);
  visit("vendor_text", identity.vendor_text);
  visit("device_family", identity.device_family);
  visit("product_family", identity.product_family);
  visit("product_name", identity.product_name);
  visit("product_number", identity.product_number);
  visit("product_text", identity.product_text);
  visit("revision_number", identity.revision_number);
  visit("order_codes", identity.order_codes);
  visit("versions", identity.versions);
  visit("build_date", identity.build_date);
  visit("specification_revision", identity.specification_revision);
  visit("instance_name", identity.instance_name);
  visit("vendor_words", identity.vendor_texts);
  visit("family_words", identity.family_texts);
  visit("product_words", identity.product_texts);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, BitRate>& rate) {
  visit.required("kbit", rate.kbit);
  visit("supported", rate.supported);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Features>& features) {
  visit("bit_rates", features.bit_rates);
  visit("default_bit_rate", features.default_bit_rate);
  visit("boot_up_master", features.boot_up_master);
  visit("boot_up_slave", features.boot_up_slave);
  visit("extended_boot_up_master", features.extended_boot_up_master);
  visit("extended_boot_up_slave", features.extended_boot_up_slave);
  visit("granularity", features.granularity);
  visit("dynamic_channels", features.dynamic_channels);
  visit("group_messaging", features.group_messaging);
  visit("rx_pdos", features.rx_pdos);
  visit("tx_pdos", features.tx_pdos);
  visit("lss_slave", features.lss_slave);
  visit("lss_master", features.lss_master);
  visit("compact_pdo", features.compact_pdo);
  visit("node_guarding_slave", features.node_guarding_slave);
  visit("node_guarding_master", features.node_guarding_master);
  visit("guarded_nodes", features.guarded_nodes);
  visit("self_starting", features.self_starting);
  visit("sdo_requesting", features.sdo_requesting);
  visit("flying_master", features.flying_master);
  visit("sdo_manager", features.sdo_manager);
  visit("configuration_manager", features.configuration_manager);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Commissioning>& commissioning) {
  visit("given", commissioning.is_given);
  visit("node_id", commissioning.node_id);
  visit("node_name", commissioning.node_name);
  visit("bit_rate", commissioning.bit_rate);
  visit("network_number", commissioning.network_number);
  visit("network_name", commissioning.network_name);
  visit("manager", commissioning.is_manager);
  visit("serial_number", commissioning.serial_number);
  visit("node_reference", commissioning.node_reference);
  visit("network_reference", commissioning.network_reference);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Dummy>& dummy) {
  visit.required("type", dummy.type);
  visit("supported", dummy.supported);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, DynamicChannel>& channel) {
  visit("data_type", channel.data_type);
  visit("access", channel.access);
  visit("first_index", channel.first_index);
  visit("last_index", channel.last_index);
  visit("max_number", channel.max_number);
  visit("offset", channel.offset);
  visit("bit_alignment", channel.bit_alignment);
  visit("others", channel.others);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, SubExtension>& extension) {
  visit("object", extension.object);
  visit("count", extension.count);
  visit("bits", extension.bits);
  visit("object_extension", extension.object_extension);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Module>& module) {
  visit.required("number", module.number);
  visit("product_name", module.product_name);
  visit("product_version", module.product_version);
  visit("product_revision", module.product_revision);
  visit("order_code", module.order_code);
  visit("comments", module.comments);
  visit("fixed_list", module.fixed_list);
  visit("fixed", module.fixed);
  visit("extension_list", module.extension_list);
  visit("extensions", module.extensions);
  visit("others", module.others);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Group>& group) {
  visit("id", group.id);
  visit("words", group.texts);
  visit("kind_of_access", group.kind_of_access);
  visit("parameters", group.parameters);
  visit("groups", group.groups);
  visit("others", group.others);
}

template <typename Visit>
void members(Visit& visit, Part<Visit, Device>& device) {
  visit.required("format", device.format);
  visit("dialect", device.dialect);
  visit("file", device.file);
  visit("device_profile", device.device_profile);
  visit("communication_profile", device.communication_profile);
  visit("identity", device.identity);
  visit("features", device.features);
  visit("commissioning", device.commissioning);
  visit("dummies", device.dummies);
  visit("comments", device.comments);
  visit("dynamic_channels", device.dynamic_channels);
  visit("mandatory", device.mandatory);
  visit("optional", device.optional);
  visit("manufacturer", device.manufacturer);
  visit("objects", device.objects);
  visit("module_count", device.module_count);
  visit("modules", device.modules);
  visit("connected_modules", device.connected_modules);
  visit("types", device.types);
  visit("parameters", device.parameters);
  visit("templates", device.templates);
  visit("allowed_templates", device.allowed_templates);
  visit("groups", device.groups);
  visit("others", device.others);
  visit.end_of(device);
}

}  // namespace lexican::codict::json
