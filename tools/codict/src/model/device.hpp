// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// The model of a device description, as plain data for all formats. It has members for data that only one format can
/// express, too. Data that no standard defines is stored with its name (struct OpaquePart), so that reading loses
/// nothing.
///
/// Objects are sorted by index, their sub-objects by sub-index, without duplicates. A large device has hundreds of
/// thousands of entries: members that most of them do not use are Rare.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/access.hpp"
#include "model/rare.hpp"
#include "model/types.hpp"
#include "model/value.hpp"

namespace lexican::codict {

/// A part of a description that the model does not interpret: a key, an attribute ("@name"), a section, an element.
struct OpaquePart {
  std::string name;
  Text text;
  std::vector<OpaquePart> children;
  Span span;  ///< of the whole part
};

// Words [311: 7.2: labels] -----------------------------------------------------------------------------------------

/// A text in one language, or a reference to such a text.
struct Label {
  std::string language;  ///< "en", "de-AT"; empty if not given
  Text text;
  Rare<std::string> dictionary;  ///< dictID of a labelRef or descriptionRef, whose textID is in `text`
  Rare<std::string> uri;
};

/// Names and descriptions of a part, in any number of languages.
struct LabelGroup {
  std::vector<Label> labels;
  std::vector<Label> descriptions;
};

/// Returns the text in a language, else the first text; empty if there is none.
std::string_view text_in(const std::vector<Label>& labels, std::string_view language);

/// Physical unit of an entry.
struct Unit {
  LabelGroup texts;
  Text multiplier;
  Text uri;
  bool is_given = false;
};

/// A value of an enumeration, with its name and description.
struct AllowedValue {
  Value value;
  LabelGroup texts;
  Rare<Text> offset;
  Rare<Text> multiplier;
};

/// A range of allowed values.
struct Range {
  Value minimum;
  Value maximum;
  Rare<Value> step;
};

/// Values and ranges to which an entry is restricted, in addition to its limits.
struct Allowed {
  std::vector<AllowedValue> values;
  std::vector<Range> ranges;
  Text template_id;  ///< id of an AllowedTemplate
};

/// Allowed values that several parameters share. [311]
struct AllowedTemplate {
  Text id;
  Allowed allowed;
};

// Data types [311: dataTypeList] -----------------------------------------------------------------------------------

/// A reference to a data type, as an element of the description names it.
struct TypeUse {
  Text iec;                ///< name of an IEC type: "UINT"
  Text reference;          ///< uniqueID of a TypeDefinition
  std::uint16_t code = 0;  ///< code of CiA 301; 0 if unknown
};

struct TypeDefinition {
  enum class Kind : unsigned char { array, structure, enumeration, derived };
  struct Bounds {
    Field<std::int64_t> lower;
    Field<std::int64_t> upper;
  };
  struct Member {
    Text name;
    Text id;
    LabelGroup texts;
    TypeUse type;
    Text size;  ///< in bits
    std::vector<OpaquePart> others;
  };

  Kind kind = Kind::structure;
  Text name;
  Text id;
  LabelGroup texts;
  TypeUse type;  ///< type of an array's elements, storage type of an enumeration, or base type of a derived type
  Text size;
  std::vector<Bounds> bounds;
  std::vector<Member> members;
  std::vector<AllowedValue> values;  ///< of an enumeration
  std::vector<OpaquePart> others;
  Span span;
};

// Objects ----------------------------------------------------------------------------------------------------------

enum class SrdoAccess : unsigned char { no, tx, rx, trx };

/// Properties that both generations of CANopenNode add to descriptions, and `;StorageLocation=` of an EDS.
struct NodeProperties {
  Rare<Field<bool>> disabled;  ///< CO_disabled: kept in the description, not generated
  Rare<Text> count_label;      ///< CO_countLabel
  /// CO_storageGroup; value "RAM": not stored (text "RAM" or "0"); empty value: a sub-object has the group of its
  /// object
  Field<std::string> storage_group;
  Rare<Field<SrdoAccess>> srdo;                  ///< CO_accessSRDO
  Rare<Field<std::uint32_t>> string_length_min;  ///< CO_stringLengthMin, in characters
  Rare<Field<std::uint32_t>> byte_length;        ///< CO_byteLength, of the older generation
  Rare<Field<bool>> extension_io;                ///< CO_extensionIO, of the older generation
  Rare<Field<bool>> flags_pdo;                   ///< CO_flagsPDO, of the older generation
};

/// Returns the storage group that an object or sub-object names; empty for RAM. The group of an object is that of its
/// sub-objects that name none.
std::string_view named_group(const NodeProperties& node);

/// A named text that an application adds to an object. [311: property]
struct Property {
  std::string name;
  Text value;
};

/// The attributes of an object without sub-objects, of a sub-object, or of an ARRAY or RECORD itself.
struct Entry {
  Text name;
  Field<ObjectCode> object_code;
  Field<std::uint16_t> data_type;  ///< index of the type; 0 if unknown
  Field<Access> access;
  Field<PdoMapping> pdo_mapping;
  Value default_value;
  Rare<Value> actual_value;      ///< configured value: ParameterValue of a DCF, actualValue of an XDC
  Rare<Value> substitute_value;  ///< [311]
  Rare<Value> low_limit;
  Rare<Value> high_limit;
  Rare<Field<std::uint32_t>> flags;  ///< ObjFlags: bit 0 no download, bit 1 no upload on scan, bit 2 effect after reset
  Rare<Text> denotation;
  Rare<Text> upload_file;          ///< of a DOMAIN [306]
  Rare<Text> download_file;        ///< of a DOMAIN [306]
  Rare<Text> parameter_reference;  ///< ParamRefd of an EDS

  Rare<Text> parameter_id;  ///< uniqueID of the parameter that describes the object [311]
  Rare<LabelGroup> texts;
  Rare<LabelGroup> denotations;  ///< `denotation` is the first of them [311]
  Rare<TypeUse> type;            ///< type that the parameter gives, in addition to data_type
  Rare<Unit> unit;
  Rare<Allowed> allowed;
  Rare<Text> access_list;
  Rare<Text> support;  ///< mandatory, optional, conditional
  Rare<std::vector<Text>> conditional_support;
  Rare<Field<bool>> persistent;
  Rare<Text> offset;
  Rare<Text> multiplier;
  Rare<Text> template_id;

  Rare<NodeProperties> node;
  Rare<std::vector<Property>> properties;  ///< all other properties
  std::vector<OpaquePart> others;          ///< keys, attributes and elements that no standard defines
  Span span;                               ///< beginning: the section's name, or the element's start tag
  Span extent;                             ///< the whole text: the section, or the element
  Span parameter_extent;                   ///< the whole text of the parameter that describes it [311]

  bool has_value() const { return !default_value.is_empty() || !actual_value->is_empty(); }
};

/// Returns the value with which a device starts: the configured value, else the default value.
const Value& value_in_force(const Entry& entry);

enum class ListKind : unsigned char { mandatory, optional, manufacturer };

struct Sub : Entry {
  std::uint8_t sub_index = 0;
  bool is_implied = false;  ///< created by compact storage: has no section
};

struct Object : Entry {
  std::uint16_t index = 0;
  std::vector<Sub> subs;
  Field<std::uint8_t> sub_number;           ///< number of sub-objects; includes sub-index 0, excludes FFh
  Field<std::uint8_t> compact;              ///< CompactSubObj: number of sub-objects that share this description [306]
  std::vector<Field<std::uint16_t>> links;  ///< ObjectLinks [306]
  bool is_listed = false;                   ///< in one of the object lists; true if the format has no lists

  const Sub* find(std::uint8_t sub_index) const;
  Sub* find(std::uint8_t sub_index);
};

/// Returns the highest sub-index except FFh, which describes the structure; 0 if there are no sub-objects.
std::uint8_t highest_sub(const Object& object);

/// A list of objects in addition to their sections. [306]
struct ObjectList {
  Field<std::uint32_t> count;
  std::vector<Field<std::uint16_t>> indexes;
  bool is_given = false;
  Span span;
};

// Device -----------------------------------------------------------------------------------------------------------

/// FileInfo [306], attributes of ProfileBody [311].
struct FileInfo {
  Text file_name;
  Field<std::uint32_t> version;
  Field<std::uint32_t> revision;
  Text eds_version;
  Text description;
  Text created_by;
  Text creation_date;
  Text creation_time;
  Text modified_by;
  Text modification_date;
  Text modification_time;
  Text last_eds;
  Text supported_languages;
  Text device_class;
};

/// ProfileHeader. [311]
struct ProfileHeader {
  Text identification;
  Text revision;
  Text name;
  Text source;
  Text class_id;
  Text date;
  std::vector<OpaquePart> others;
};

/// Version of a part of the device. [311]
struct Version {
  Text type;  ///< SW, FW, HW
  Text text;
};

/// DeviceInfo [306], DeviceIdentity [311].
struct Identity {
  Text vendor_name;
  Field<std::uint32_t> vendor_number;
  Text vendor_text;
  Text device_family;
  Text product_family;
  Text product_name;
  Field<std::uint32_t> product_number;
  Text product_text;
  Field<std::uint32_t> revision_number;
  std::vector<Text> order_codes;
  std::vector<Version> versions;
  Text build_date;
  Text specification_revision;
  Text instance_name;
  LabelGroup vendor_texts;   ///< `vendor_text` is the first of them [311]
  LabelGroup family_texts;   ///< `device_family` is the first of them [311]
  LabelGroup product_texts;  ///< `product_text` is the first of them [311]
};

struct BitRate {
  std::uint32_t kbit = 0;  ///< kbit/s; 0: automatic bit rate detection
  Field<bool> supported;
};

/// Communication features of a device. [306: DeviceInfo; 311: CANopenGeneralFeatures, CANopenMasterFeatures]
struct Features {
  std::vector<BitRate> bit_rates;
  Field<std::uint32_t> default_bit_rate;  ///< kbit/s [311]
  Field<bool> boot_up_master;
  Field<bool> boot_up_slave;
  Field<bool> extended_boot_up_master;
  Field<bool> extended_boot_up_slave;
  Field<std::uint8_t> granularity;
  Field<std::uint32_t> dynamic_channels;
  Field<bool> group_messaging;
  Field<std::uint16_t> rx_pdos;
  Field<std::uint16_t> tx_pdos;
  Field<bool> lss_slave;
  Field<bool> lss_master;
  Field<std::uint32_t> compact_pdo;  ///< bit n: sub-index n + 1 of the PDOs without a section
  Field<bool> node_guarding_slave;
  Field<bool> node_guarding_master;
  Field<std::uint16_t> guarded_nodes;  ///< NrOfNG_MonitoredNodes
  Field<bool> self_starting;
  Field<bool> sdo_requesting;
  Field<bool> flying_master;
  Field<bool> sdo_manager;
  Field<bool> configuration_manager;
};

/// DeviceComissioning. [306, 311]
struct Commissioning {
  bool is_given = false;
  Field<std::uint8_t> node_id;
  Text node_name;
  Field<std::uint32_t> bit_rate;  ///< kbit/s
  Field<std::uint32_t> network_number;
  Text network_name;
  Field<bool> is_manager;
  Field<std::uint32_t> serial_number;      ///< LSS_SerialNumber
  Field<std::uint32_t> node_reference;     ///< NodeRefd
  Field<std::uint32_t> network_reference;  ///< NetRefd
};

/// A data type that the device supports as a dummy entry of an RPDO. [306: DummyUsage]
struct Dummy {
  std::uint16_t type = 0;  ///< index of the data type
  Field<bool> supported;
};

/// Range of objects that a programmable device creates for its network variables. [306: DynamicChannels; 311:
/// dynamicChannels]
struct DynamicChannel {
  Field<std::uint16_t> data_type;
  Field<Access> access;  ///< gives the direction
  Field<std::uint16_t> first_index;
  Field<std::uint16_t> last_index;
  Field<std::uint32_t> max_number;
  Field<std::uint32_t> offset;         ///< PPOffset, addressOffset
  Field<std::uint32_t> bit_alignment;  ///< [311]
  std::vector<OpaquePart> others;
};

/// An object by which a module extends its coupler. [306]
struct SubExtension {
  Object object;
  Field<std::uint16_t> count;  ///< number of sub-objects for each module …
  Field<std::uint16_t> bits;   ///< … or, in the form "0;bits", bits of one sub-object
  Field<std::uint32_t> object_extension;
};

/// A module of a bus coupler. [306]
struct Module {
  std::uint16_t number = 0;
  Text product_name;
  Text product_version;
  Text product_revision;
  Text order_code;
  std::vector<Text> comments;
  ObjectList fixed_list;
  std::vector<Object> fixed;
  ObjectList extension_list;
  std::vector<SubExtension> extensions;
  std::vector<OpaquePart> others;
};

/// parameterGroup: a group in a hierarchy of parameters. [311]
struct Group {
  Text id;
  LabelGroup texts;
  Text kind_of_access;
  std::vector<Text> parameters;  ///< Entry::parameter_id of the members
  std::vector<Group> groups;
  std::vector<OpaquePart> others;
};

enum class Format : unsigned char { eds, dcf, xdd10, xdd11, xdc10, xdc11, xpd, nxdd, project_xml, other_xml };

std::string_view name_of(Format format);

struct Device {
  Format format = Format::eds;
  std::string dialect;  ///< name of a private dialect; empty for the standards

  FileInfo file;
  ProfileHeader device_profile;         ///< [311]
  ProfileHeader communication_profile;  ///< [311]
  Identity identity;
  Features features;
  Commissioning commissioning;
  std::vector<Dummy> dummies;
  std::vector<Text> comments;
  std::vector<DynamicChannel> dynamic_channels;

  ObjectList mandatory;
  ObjectList optional;
  ObjectList manufacturer;
  std::vector<Object> objects;

  Field<std::uint32_t> module_count;  ///< SupportedModules
  std::vector<Module> modules;
  std::vector<Field<std::uint16_t>> connected_modules;  ///< of a DCF: module numbers, by slot

  std::vector<TypeDefinition> types;
  std::vector<Entry> parameters;  ///< parameters that no object refers to
  std::vector<Entry> templates;   ///< templates, whose id is in parameter_id
  std::vector<AllowedTemplate> allowed_templates;
  std::vector<Group> groups;

  std::vector<OpaquePart> others;  ///< sections and elements without a member, such as [Tools] and indicatorList

  const Object* find(std::uint16_t index) const;
  Object* find(std::uint16_t index);
  /// Returns an entry; null if there is none. An object without sub-objects is found with sub-index 0.
  const Entry* find(std::uint16_t index, std::uint8_t sub_index) const;
};

/// The contents of a file; usually one device.
struct Description {
  std::vector<Device> devices;
};

/// Calls call(index, sub_index, entry) for each variable, in order: a sub-object, or an object without sub-objects,
/// whose sub-index is 0.
void for_each_variable(const Device& device,
                       const std::function<void(std::uint16_t, std::uint8_t, const Entry&)>& call);

/// Returns the list in which CiA 306 requires an object.
ListKind list_of(std::uint16_t index);

/// Returns the allowed values of an entry, with their names: its own, else those of its enumeration. Empty: all values
/// of its type are allowed.
const std::vector<AllowedValue>& allowed_values_of(const Device& device, const Entry& entry);

/// Returns true for a type of CANFestival that restricts the range of another one: a RECORD of 00A0h to 0FFFh with the
/// code of that type in sub-index 1, the lowest value in 2 and the highest in 3.
bool is_range_type(const Object& object);

/// Returns width and form of a data type of this device: a type of CiA 301, the type that a DEFTYPE object or a range
/// type names, kind structure for a DEFSTRUCT object, else kind unknown.
const DataType& data_type_of(const Device& device, std::uint16_t code);

}  // namespace lexican::codict
