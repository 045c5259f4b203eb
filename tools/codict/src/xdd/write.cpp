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

// Returns a copy of a device without the kept parts of other formats, which no schema allows. Keys of an EDS are
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
      : device_(device), out_(edition), rest_(device.others), entries_(out_, device) {}

  std::string written() {
    out_.open("ISO15745ProfileContainer");
    const bool is_qualified = out_.is_qualified();
    out_.attribute(
        is_qualified ? "xmlns" : "xmlns:co",
        std::string_view(is_qualified ? "http://www.canopen.org/xml/1.0" : "http://www.canopen.org/xml/1.1"));
    out_.attribute("xmlns:xsi", schema_instance);
    device_profile();
    network_profile();
    out_.elements_of(rest_);
    out_.close();
    return out_.take();
  }

 private:
  void header(const ProfileHeader& header, std::string_view identification, std::string_view class_id) {
    const bool is_given = header.identification.is_given || header.class_id.is_given;
    const auto text = [&](const Text& given, std::string_view other) {
      return is_given ? std::string_view(given.text) : other;
    };
    Rest rest(header.others);
    out_.open("ProfileHeader");
    out_.element("ProfileIdentification", text(header.identification, identification));
    out_.element("ProfileRevision", text(header.revision, "1"));
    out_.element("ProfileName", text(header.name, device_.identity.product_name.text));
    out_.element("ProfileSource", text(header.source, device_.identity.vendor_name.text));
    out_.element("ProfileClassID", text(header.class_id, class_id));
    if (header.date.is_given) {
      out_.element("ProfileDate", header.date.text);
    }
    const Kept* const reference = rest.take("ISO15745Reference");
    if (reference != nullptr) {
      out_.kept(*reference);
    } else {
      out_.open("ISO15745Reference");
      out_.element("ISO15745Part", "1");
      out_.element("ISO15745Edition", "1");
      out_.element("ProfileTechnology", "CANopen");
      out_.close();
    }
    out_.elements_of(rest);
    out_.close();
  }

  // Opens a body and writes its attributes. `own`: attributes by which the second body differs from the first.
  void body(std::string_view type, const Rest& own) {
    const FileInfo& file = device_.file;
    out_.open("ProfileBody");
    out_.attribute("xsi:type", (out_.is_qualified() ? "" : "co:") + std::string(type));
    out_.attributes_of(own);
    out_.attribute("formatName", std::string_view("CANopen"));
    out_.attribute("formatVersion", std::string_view("1.0"));
    const auto attribute = [&](std::string_view name, const std::string& text, bool is_wanted) {
      const bool is_said = std::any_of(own.all().begin(), own.all().end(),
                                       [name](const Kept* kept) { return kept->name == "@" + std::string(name); });
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
    const Kept* const of_body = rest_.take("ProfileBody");  // kept attributes of the second body
    second_body_ = of_body;
    out_.open("ISO15745Profile");
    header(device_.device_profile, "CANopen device profile", "Device");
    body("ProfileBody_Device_CANopen", Rest());
    identity();
    kept("DeviceManager");
    if (!kept("DeviceFunction")) {
      device_function();
    }
    process();
    out_.close();
    out_.close();
  }

  bool kept(std::string_view name) {
    const Kept* const found = rest_.take(name);
    if (found != nullptr) {
      out_.kept(*found);
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

  void identity_text(Rest& rest, std::string_view name, const Text& text, bool is_wanted = false) {
    if (!text.is_given && !is_wanted) {
      return;
    }
    out_.open(name);
    const Kept* const left = rest.take_left(name, {});
    const Rest of_left = left != nullptr ? Rest(left->children) : Rest();
    out_.attributes_of(of_left);
    if (text.is_empty()) {
      out_.elements_of(of_left);
    }
    out_.text(text.text);
    out_.close();
  }

  void identity_words(Rest& rest, std::string_view name, const Words& words, const Text& text,
                      const std::string& eds_keys = {}) {
    if (!text.is_given && eds_keys.empty()) {
      return;
    }
    out_.open(name);
    const Kept* const left = rest.take_left(name, {});
    const Rest of_left = left != nullptr ? Rest(left->children) : Rest();
    out_.attributes_of(of_left);
    print_words(out_, words);
    if (!eds_keys.empty()) {
      out_.open("description");
      out_.attribute("lang", std::string_view("en"));
      out_.text(eds_keys);
      out_.close();
    }
    out_.elements_of(of_left);
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
    const Kept* const left = rest_.take("DeviceIdentity");
    Rest rest = left != nullptr ? Rest(left->children) : Rest();
    out_.open("DeviceIdentity");
    identity_text(rest, "vendorName", identity.vendor_name, true);
    identity_text(rest, "vendorID", identity.vendor_number);
    identity_words(rest, "vendorText", identity.vendor_words, identity.vendor_text);
    identity_words(rest, "deviceFamily", identity.family_words, identity.device_family);
    identity_text(rest, "productFamily", identity.product_family);
    identity_text(rest, "productName", identity.product_name, true);
    identity_text(rest, "productID", identity.product_number);
    identity_words(rest, "productText", identity.product_words, identity.product_text, eds_keys());
    for (const Text& code : identity.order_codes) {
      identity_text(rest, "orderNumber", code);
    }
    for (const Version& version : identity.versions) {
      out_.open("version");
      const Kept* const of_version = rest.take_left("version", "versionType");
      out_.attribute("versionType", version.type);
      out_.attributes_of(of_version != nullptr ? Rest(of_version->children) : Rest());
      out_.text(version.text.text);
      out_.close();
    }
    identity_text(rest, "buildDate", identity.build_date);
    identity_text(rest, "specificationRevision", identity.specification_revision);
    identity_text(rest, "instanceName", identity.instance_name);
    out_.elements_of(rest);
    out_.close();
  }

  void process() {
    const Kept* const left = rest_.take("ApplicationProcess");
    Rest rest = left != nullptr ? Rest(left->children) : Rest();
    if (!entries_.has_parameters() && device_.types.empty() && device_.groups.empty() && device_.templates.empty() &&
        device_.allowed_templates.empty() && left == nullptr) {
      return;
    }
    out_.open("ApplicationProcess");
    entries_.types(rest.take("dataTypeList"));
    for (const std::string_view name : {"functionTypeList", "functionInstanceList"}) {
      if (const Kept* const list = rest.take(name)) {
        out_.kept(*list);
      }
    }
    entries_.templates(rest.take("templateList"));
    entries_.parameters(rest.take("parameterList"));
    entries_.groups(rest.take("parameterGroupList"));
    out_.elements_of(rest);
    out_.close();
  }

  void network_profile() {
    out_.open("ISO15745Profile");
    header(device_.communication_profile, "CANopen communication network profile", "CommunicationNetwork");
    body("ProfileBody_CommunicationNetwork_CANopen", second_body_ != nullptr ? Rest(second_body_->children) : Rest());
    layers();
    print_transport(out_, device_, rest_.take("TransportLayers"), rest_.take("baudRate"));
    print_management(out_, device_, rest_.take("NetworkManagement"));
    out_.close();
    out_.close();
  }

  void layers() {
    const Kept* const left = rest_.take("ApplicationLayers");
    Rest rest = left != nullptr ? Rest(left->children) : Rest();
    out_.open("ApplicationLayers");
    entries_.objects(rest_.take("CANopenObjectList"));
    if (const Kept* const identity = rest.take("identity")) {
      out_.kept(*identity);
    }
    print_dummies(out_, device_, rest.take("dummyUsage"));
    print_channels(out_, device_, rest.take("dynamicChannels"));
    out_.elements_of(rest);
    out_.close();
  }

  const Device& device_;
  Printer out_;
  Rest rest_;
  EntryWriter entries_;
  const Kept* second_body_ = nullptr;
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
