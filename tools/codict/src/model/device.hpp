// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// A device as its description describes it, in any format: plain data. What only one format can say has its place
/// here, too, and what no standard knows is kept by name: reading loses nothing.
///
/// Objects are sorted by index, their sub-objects by sub-index, each once.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/access.hpp"
#include "model/types.hpp"
#include "model/value.hpp"

namespace lexican::codict {

/// What is kept although it has no meaning here: a key, an attribute ("@name"), a section, an element.
struct Kept {
  std::string name;
  Text text;
  std::vector<Kept> children;
  Span span;  ///< of all of it
};

// Words [311: 7.2: labels] -----------------------------------------------------------------------------------------

struct Label {
  std::string language;  ///< "en", "de-AT"; empty where none is given
  Text text;
  std::string dictionary;  ///< of labelRef and descriptionRef: dictID, and the textID is the text
  std::string uri;
};

struct Words {
  std::vector<Label> labels;
  std::vector<Label> descriptions;
};

/// The text in a language, or the first there is; empty if there is none.
std::string_view text_in(const std::vector<Label>& labels, std::string_view language);

struct Unit {
  Words words;
  Text multiplier;
  Text uri;
  bool is_given = false;
};

/// A value of an enumeration, with its name.
struct AllowedValue {
  Value value;
  Words words;
  Text offset;
  Text multiplier;
};

struct Range {
  Value minimum;
  Value maximum;
  Value step;
};

struct Allowed {
  std::vector<AllowedValue> values;
  std::vector<Range> ranges;
  Text template_id;  ///< of an AllowedTemplate
};

struct AllowedTemplate {
  Text id;
  Allowed allowed;
};

// Data types [311: dataTypeList] -----------------------------------------------------------------------------------

/// The type that an element names, as it names it.
struct TypeUse {
  Text iec;                ///< name of an IEC type: "UINT"
  Text reference;          ///< uniqueID of a TypeDefinition
  std::uint16_t code = 0;  ///< of CiA 301; 0 where it is not known
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
    Words words;
    TypeUse type;
    Text size;  ///< in bits
    std::vector<Kept> others;
  };

  Kind kind = Kind::structure;
  Text name;
  Text id;
  Words words;
  TypeUse type;  ///< of an array's elements, what an enumeration is stored as, what a type is derived from
  Text size;
  std::vector<Bounds> bounds;
  std::vector<Member> members;
  std::vector<AllowedValue> values;  ///< of an enumeration
  std::vector<Kept> others;
  Span span;
};

// Objects ----------------------------------------------------------------------------------------------------------

enum class SrdoAccess : unsigned char { no, tx, rx, trx };

/// What CANopenNode adds to descriptions, in both of its generations, and `;StorageLocation=` of an EDS.
struct NodeProperties {
  Field<bool> disabled;              ///< CO_disabled: kept in the description, and nowhere else
  Text count_label;                  ///< CO_countLabel
  Field<std::string> storage_group;  ///< CO_storageGroup; value "RAM" where nothing is stored, also for the number 0
  Field<SrdoAccess> srdo;            ///< CO_accessSRDO
  Field<std::uint32_t> string_length_min;  ///< CO_stringLengthMin, in characters
  Field<std::uint32_t> byte_length;        ///< CO_byteLength, of the older generation
  Field<bool> extension_io;                ///< CO_extensionIO, of the older generation
  Field<bool> flags_pdo;                   ///< CO_flagsPDO, of the older generation
};

struct Property {
  std::string name;
  Text value;
};

/// A value with its rules: an object without sub-objects, a sub-object, and what an ARRAY or RECORD says of itself.
struct Entry {
  Text name;
  Field<ObjectCode> object_code;
  Field<std::uint16_t> data_type;  ///< index of the type; 0 where it is not known
  Field<Access> access;
  Field<PdoMapping> pdo_mapping;
  Value default_value;
  Value actual_value;      ///< ParameterValue of a DCF, actualValue of an XDC: what is to be configured
  Value substitute_value;  ///< [311]
  Value low_limit;
  Value high_limit;
  Field<std::uint32_t> flags;  ///< ObjFlags: bit 0 no download, bit 1 no upload on scan, bit 2 effect after reset
  Text denotation;
  Text upload_file;          ///< of a DOMAIN [306]
  Text download_file;        ///< of a DOMAIN [306]
  Text parameter_reference;  ///< ParamRefd of an EDS

  Text parameter_id;  ///< uniqueID of the parameter that describes it [311]
  Words words;
  Words denotations;  ///< denotation is the first of them [311]
  TypeUse type;       ///< what the parameter says of its type, beside data_type
  Unit unit;
  Allowed allowed;
  Text access_list;
  Text support;  ///< mandatory, optional, conditional
  std::vector<Text> conditional_support;
  Field<bool> persistent;
  Text offset;
  Text multiplier;
  Text template_id;

  NodeProperties node;
  std::vector<Property> properties;  ///< all others
  std::vector<Kept> others;          ///< keys, attributes and elements that no standard knows
  Span span;                         ///< where it begins: the section's name, the element's start tag
  Span extent;                       ///< its whole text: the section, the element
  Span parameter_extent;             ///< of the parameter that describes it [311]

  bool has_value() const { return default_value.is_given || actual_value.is_given; }
};

/// From which a device starts: what is configured goes before the default value.
const Value& value_in_force(const Entry& entry);

enum class ListKind : unsigned char { mandatory, optional, manufacturer };

struct Sub : Entry {
  std::uint8_t sub_index = 0;
  bool is_implied = false;  ///< by compact storage: no section of its own
};

struct Object : Entry {
  std::uint16_t index = 0;
  std::vector<Sub> subs;
  Field<std::uint8_t> sub_number;           ///< implemented sub-objects, 0 with them and FFh without
  Field<std::uint8_t> compact;              ///< CompactSubObj: as many like this one [306]
  std::vector<Field<std::uint16_t>> links;  ///< ObjectLinks [306]
  bool is_listed = false;                   ///< in one of the object lists, or the format has none

  const Sub* find(std::uint8_t sub_index) const;
  Sub* find(std::uint8_t sub_index);
};

/// Below FFh, which describes the structure; 0 if there are no sub-objects.
std::uint8_t highest_sub(const Object& object);

/// A list of objects beside the objects themselves. [306]
struct ObjectList {
  Field<std::uint32_t> count;
  std::vector<Field<std::uint16_t>> indexes;
  bool is_given = false;
  Span span;
};

// What belongs to the whole device ---------------------------------------------------------------------------------

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
  std::vector<Kept> others;
};

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
  Words vendor_words;   ///< vendor_text is the first of them [311]
  Words family_words;   ///< device_family is the first of them [311]
  Words product_words;  ///< product_text is the first of them [311]
};

struct BitRate {
  std::uint32_t kbit = 0;  ///< 0: found by the device itself
  Field<bool> supported;
};

/// What the device can do in a network. [306: DeviceInfo; 311: CANopenGeneralFeatures, CANopenMasterFeatures]
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
  Field<std::uint32_t> compact_pdo;  ///< bit n: sub-index n + 1 of the PDOs that are not described
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

struct Dummy {
  std::uint16_t type = 0;
  Field<bool> supported;
};

struct DynamicChannel {
  Field<std::uint16_t> data_type;
  Field<Access> access;  ///< the direction
  Field<std::uint16_t> first_index;
  Field<std::uint16_t> last_index;
  Field<std::uint32_t> max_number;
  Field<std::uint32_t> offset;         ///< PPOffset, addressOffset
  Field<std::uint32_t> bit_alignment;  ///< [311]
  std::vector<Kept> others;
};

/// What a module adds to an object of its coupler. [306]
struct SubExtension {
  Object object;
  Field<std::uint16_t> count;  ///< sub-objects of a module …
  Field<std::uint16_t> bits;   ///< … or, "0;bits", so many bits of one
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
  std::vector<Kept> others;
};

/// parameterGroup: a chapter. [311]
struct Group {
  Text id;
  Words words;
  Text kind_of_access;
  std::vector<Text> parameters;  ///< Entry::parameter_id of its members
  std::vector<Group> groups;
  std::vector<Kept> others;
};

enum class Format : unsigned char { eds, dcf, xdd10, xdd11, xdc10, xdc11, xpd, nxdd, project_xml, other_xml };

std::string_view name_of(Format format);

struct Device {
  Format format = Format::eds;
  std::string dialect;  ///< name of a private dialect; empty for what the standards describe

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
  std::vector<Field<std::uint16_t>> connected_modules;  ///< of a DCF: module numbers, in the order of the slots

  std::vector<TypeDefinition> types;
  std::vector<Entry> parameters;  ///< those that no object refers to
  std::vector<Entry> templates;   ///< their id is parameter_id
  std::vector<AllowedTemplate> allowed_templates;
  std::vector<Group> groups;

  std::vector<Kept> others;  ///< sections and elements with no place of their own, [Tools] and indicatorList with them

  const Object* find(std::uint16_t index) const;
  Object* find(std::uint16_t index);
  /// An object without sub-objects is its own sub-index 0; null if there is none.
  const Entry* find(std::uint16_t index, std::uint8_t sub_index) const;
};

/// All that one file describes: one device, as a rule.
struct Description {
  std::vector<Device> devices;
};

/// Every value of a device that SDO can reach: call(index, sub_index, entry), in order. An object without sub-objects
/// has sub-index 0.
void for_each_variable(const Device& device,
                       const std::function<void(std::uint16_t, std::uint8_t, const Entry&)>& call);

/// The list in which CiA 306 wants an object.
ListKind list_of(std::uint16_t index);

/// The values that an entry can have, with their names: its own, else those of its enumeration; empty: all of its type.
const std::vector<AllowedValue>& allowed_values_of(const Device& device, const Entry& entry);

/// The width and form of a type of this device: one of CiA 301, or what its DEFTYPE object is; kind structure for a
/// DEFSTRUCT object; else unknown.
const DataType& data_type_of(const Device& device, std::uint16_t code);

}  // namespace lexican::codict
