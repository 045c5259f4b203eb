// SPDX-License-Identifier: Apache-2.0
#include "xdd/write.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <utility>

#include "model/date.hpp"
#include "text/number.hpp"
#include "xdd/writer.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::string_view schema_instance = "http://www.w3.org/2001/XMLSchema-instance";

void drop_groups_parts(std::vector<Group>& groups) {
  for (Group& group : groups) {
    group.others.clear();
    drop_groups_parts(group.groups);
  }
}

void drop_types_parts(std::vector<TypeDefinition>& types) {
  for (TypeDefinition& type : types) {
    type.others.clear();
    for (TypeDefinition::Member& member : type.members) {
      member.others.clear();
    }
  }
}

// Returns a copy of a device without the opaque parts of other formats, which no schema allows. Keys of an EDS are
// preserved: they become properties.
Device without_private_parts(const Device& device) {
  Device plain = device;
  plain.others.clear();
  plain.device_profile.others.clear();
  plain.communication_profile.others.clear();
  drop_groups_parts(plain.groups);
  drop_types_parts(plain.types);
  if (device.format == Format::eds || device.format == Format::dcf) {
    return plain;
  }
  for (Object& object : plain.objects) {
    object.others.clear();
    for (Sub& sub : object.subs) {
      sub.others.clear();
    }
  }
  for (std::vector<Entry>* entries : {&plain.parameters, &plain.templates}) {
    for (Entry& entry : *entries) {
      entry.others.clear();
    }
  }
  return plain;
}

// Writes an attribute if it is given.
void print_attribute(Printer& out, std::string_view name, const std::string& text, bool is_given) {
  if (is_given) {
    out.attribute(name, std::string_view(text));
  }
}

class DeviceWriter {
 public:
  DeviceWriter(const Device& device, Edition edition)
      : device_(device), out_(edition), opaque_(device.others), entries_(out_, device) {}

  std::string written() {
    out_.open("ISO15745ProfileContainer");
    const bool is_qualified = out_.is_qualified();
    out_.attribute(
        is_qualified ? "xmlns" : "xmlns:co",
        std::string_view(is_qualified ? "http://www.canopen.org/xml/1.0" : "http://www.canopen.org/xml/1.1"));
    out_.attribute("xmlns:xsi", schema_instance);
    device_profile();
    network_profile();
    out_.elements_of(opaque_);
    out_.close();
    return out_.take_text();
  }

 private:
  void header(const ProfileHeader& header, std::string_view identification, std::string_view class_id) {
    const bool is_given = header.identification.is_given || header.class_id.is_given;
    const auto text = [&](const Text& given, std::string_view other) {
      return is_given ? std::string_view(given.text) : other;
    };
    OpaqueParts opaque(header.others);
    out_.open("ProfileHeader");
    out_.element("ProfileIdentification", text(header.identification, identification));
    out_.element("ProfileRevision", text(header.revision, "1"));
    out_.element("ProfileName", text(header.name, device_.identity.product_name.text));
    out_.element("ProfileSource", text(header.source, device_.identity.vendor_name.text));
    out_.element("ProfileClassID", text(header.class_id, class_id));
    if (header.date.is_given) {
      out_.element("ProfileDate", header.date.text);
    }
    const OpaquePart* const reference = opaque.remove_first("ISO15745Reference");
    if (reference != nullptr) {
      out_.print_opaque(*reference);
    } else {
      out_.open("ISO15745Reference");
      out_.element("ISO15745Part", "1");
      out_.element("ISO15745Edition", "1");
      out_.element("ProfileTechnology", "CANopen");
      out_.close();
    }
    out_.elements_of(opaque);
    out_.close();
  }

  // Opens a body and writes its attributes. `own`: attributes by which the second body differs from the first.
  void body(std::string_view type, const OpaqueParts& own) {
    const FileInfo& file = device_.file;
    out_.open("ProfileBody");
    out_.attribute("xsi:type", (out_.is_qualified() ? "" : "co:") + std::string(type));
    out_.attributes_of(own);
    out_.attribute("formatName", std::string_view("CANopen"));
    out_.attribute("formatVersion", std::string_view("1.0"));
    const auto attribute = [&](std::string_view name, const std::string& text, bool is_wanted) {
      const bool is_said = std::any_of(own.all().begin(), own.all().end(), [name](const OpaquePart* part) {
        return part->name == "@" + std::string(name);
      });
      print_attribute(out_, name, text, is_wanted && !is_said);
    };
    attribute("fileName", file.file_name.text, true);
    attribute("fileCreator", file.created_by.text, true);
    attribute("fileCreationDate", schema_date(file.creation_date.text), true);
    attribute("fileCreationTime", schema_time(file.creation_time.text), file.creation_time.is_given);
    attribute("fileModificationDate", schema_date(file.modification_date.text), file.modification_date.is_given);
    attribute("fileModificationTime", schema_time(file.modification_time.text), file.modification_time.is_given);
    attribute("fileModifiedBy", file.modified_by.text, file.modified_by.is_given);
    attribute("fileVersion", file.version.text, true);
    attribute("supportedLanguages", file.supported_languages.text, file.supported_languages.is_given);
    if (type == "ProfileBody_Device_CANopen") {
      attribute("deviceClass", file.device_class.text, file.device_class.is_given);
    }
  }

  void device_profile() {
    const OpaquePart* const of_body = opaque_.remove_first("ProfileBody");  // opaque attributes of the second body
    second_body_ = of_body;
    out_.open("ISO15745Profile");
    header(device_.device_profile, "CANopen device profile", "Device");
    body("ProfileBody_Device_CANopen", OpaqueParts());
    identity();
    print_stored("DeviceManager");
    if (!print_stored("DeviceFunction")) {
      device_function();
    }
    process();
    out_.close();
    out_.close();
  }

  bool print_stored(std::string_view name) {
    const OpaquePart* const found = opaque_.remove_first(name);
    if (found != nullptr) {
      out_.print_opaque(*found);
    }
    return found != nullptr;
  }

  // Writes a DeviceFunction with one characteristic, because the schema requires at least one.
  void device_function() {
    const std::array<std::string_view, 4> names = {"DeviceFunction", "capabilities", "characteristicsList",
                                                   "characteristic"};
    for (const std::string_view name : names) {
      out_.open(name);
    }
    for (const std::string_view name : {"characteristicName", "characteristicContent"}) {
      out_.open(name);
      out_.open("label");
      out_.attribute("lang", std::string_view("en"));
      out_.text(name == "characteristicName" ? "Protocol" : "CANopen");
      out_.close();
      out_.close();
    }
    for (std::size_t n = 0; n < names.size(); ++n) {
      out_.close();
    }
  }

  void identity_text(OpaqueParts& opaque, std::string_view name, const Text& text, bool is_wanted = false) {
    if (!text.is_given && !is_wanted) {
      return;
    }
    out_.open(name);
    const OpaquePart* const remainder = opaque.remove_remainder(name, {});
    const OpaqueParts remainder_parts = remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
    out_.attributes_of(remainder_parts);
    if (text.is_empty()) {
      out_.elements_of(remainder_parts);
    }
    out_.text(text.text);
    out_.close();
  }

  void identity_texts(OpaqueParts& opaque, std::string_view name, const LabelGroup& texts, const Text& text,
                      const std::string& eds_keys = {}) {
    if (!text.is_given && eds_keys.empty()) {
      return;
    }
    out_.open(name);
    const OpaquePart* const remainder = opaque.remove_remainder(name, {});
    const OpaqueParts remainder_parts = remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
    out_.attributes_of(remainder_parts);
    print_labels(out_, texts);
    if (!eds_keys.empty()) {
      out_.open("description");
      out_.attribute("lang", std::string_view("en"));
      out_.text(eds_keys);
      out_.close();
    }
    out_.elements_of(remainder_parts);
    out_.close();
  }

  // Returns the keys of an EDS that CiA 311 lacks, in the form of CANeds.
  std::string eds_keys() const {
    const auto has_sign = [](const Text& text) { return text.text.find('|') != std::string::npos; };
    const FileInfo& file = device_.file;
    const bool is_any = file.description.is_given || file.eds_version.is_given || file.revision.is_given ||
                        device_.identity.revision_number.is_given;
    if (!is_any) {
      return {};
    }
    std::string keys = "FileDescription=" + (has_sign(file.description) ? "" : file.description.text) + "|";
    const auto add = [&keys, has_sign](std::string_view name, const Text& text) {
      if (text.is_given && !has_sign(text)) {
        keys += std::string(name) + "=" + text.text + "|";
      }
    };
    add("EdsVersion", file.eds_version);
    add("FileRevison", file.revision);
    add("RevisionNum", device_.identity.revision_number);
    return keys;
  }

  void identity() {
    const Identity& identity = device_.identity;
    const OpaquePart* const remainder = opaque_.remove_first("DeviceIdentity");
    OpaqueParts opaque = remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
    out_.open("DeviceIdentity");
    identity_text(opaque, "vendorName", identity.vendor_name, true);
    identity_text(opaque, "vendorID", identity.vendor_number);
    identity_texts(opaque, "vendorText", identity.vendor_texts, identity.vendor_text);
    identity_texts(opaque, "deviceFamily", identity.family_texts, identity.device_family);
    identity_text(opaque, "productFamily", identity.product_family);
    identity_text(opaque, "productName", identity.product_name, true);
    identity_text(opaque, "productID", identity.product_number);
    identity_texts(opaque, "productText", identity.product_texts, identity.product_text, eds_keys());
    for (const Text& code : identity.order_codes) {
      identity_text(opaque, "orderNumber", code);
    }
    for (const Version& version : identity.versions) {
      out_.open("version");
      const OpaquePart* const of_version = opaque.remove_remainder("version", "versionType");
      out_.attribute("versionType", version.type);
      out_.attributes_of(of_version != nullptr ? OpaqueParts(of_version->children) : OpaqueParts());
      out_.text(version.text.text);
      out_.close();
    }
    identity_text(opaque, "buildDate", identity.build_date);
    identity_text(opaque, "specificationRevision", identity.specification_revision);
    identity_text(opaque, "instanceName", identity.instance_name);
    out_.elements_of(opaque);
    out_.close();
  }

  void process() {
    const OpaquePart* const remainder = opaque_.remove_first("ApplicationProcess");
    OpaqueParts opaque = remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
    if (!entries_.has_parameters() && device_.types.empty() && device_.groups.empty() && device_.templates.empty() &&
        device_.allowed_templates.empty() && remainder == nullptr) {
      return;
    }
    out_.open("ApplicationProcess");
    entries_.types(opaque.remove_first("dataTypeList"));
    for (const std::string_view name : {"functionTypeList", "functionInstanceList"}) {
      if (const OpaquePart* const list = opaque.remove_first(name)) {
        out_.print_opaque(*list);
      }
    }
    entries_.templates(opaque.remove_first("templateList"));
    entries_.parameters(opaque.remove_first("parameterList"));
    entries_.groups(opaque.remove_first("parameterGroupList"));
    out_.elements_of(opaque);
    out_.close();
  }

  void network_profile() {
    out_.open("ISO15745Profile");
    header(device_.communication_profile, "CANopen communication network profile", "CommunicationNetwork");
    body("ProfileBody_CommunicationNetwork_CANopen",
         second_body_ != nullptr ? OpaqueParts(second_body_->children) : OpaqueParts());
    layers();
    print_transport(out_, device_, opaque_.remove_first("TransportLayers"), opaque_.remove_first("baudRate"));
    print_management(out_, device_, opaque_.remove_first("NetworkManagement"));
    out_.close();
    out_.close();
  }

  void layers() {
    const OpaquePart* const remainder = opaque_.remove_first("ApplicationLayers");
    OpaqueParts opaque = remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
    out_.open("ApplicationLayers");
    entries_.objects(opaque_.remove_first("CANopenObjectList"));
    if (const OpaquePart* const identity = opaque.remove_first("identity")) {
      out_.print_opaque(*identity);
    }
    print_dummies(out_, device_, opaque.remove_first("dummyUsage"));
    print_channels(out_, device_, opaque.remove_first("dynamicChannels"));
    out_.elements_of(opaque);
    out_.close();
  }

  const Device& device_;
  Printer out_;
  OpaqueParts opaque_;
  EntryWriter entries_;
  const OpaquePart* second_body_ = nullptr;
};

}  // namespace

std::string write(const Device& device, Edition edition) {
  switch (device.format) {
    case Format::eds:
    case Format::dcf:
    case Format::project_xml:
    case Format::other_xml: return DeviceWriter(without_private_parts(device), edition).written();
    default: return DeviceWriter(device, edition).written();
  }
}

}  // namespace lexican::codict::xdd
