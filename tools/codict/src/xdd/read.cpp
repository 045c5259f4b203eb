// SPDX-License-Identifier: Apache-2.0
#include "xdd/read.hpp"

#include <string>
#include <utility>
#include <vector>

#include "xdd/parts.hpp"
#include "xdd/recognise.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::string_view namespace10 = "http://www.canopen.org/xml/1.0";
constexpr std::string_view namespace11 = "http://www.canopen.org/xml/1.1";

bool has_ending(std::string_view path, std::string_view ending) {
  return path.size() > ending.size() && equal_ignoring_case(path.substr(path.size() - ending.size()), ending);
}

// Returns the declaration of an element's namespace, in the element or above: xmlns, or xmlns:prefix. Null if missing.
pugi::xml_attribute namespace_of(pugi::xml_node element) {
  const std::string_view name = element.name();
  const std::size_t colon = name.find(':');
  const std::string wanted = colon == std::string_view::npos ? "xmlns" : "xmlns:" + std::string(name.substr(0, colon));
  for (pugi::xml_node node = element; node; node = node.parent()) {
    if (const pugi::xml_attribute attribute = node.attribute(wanted.c_str())) {
      return attribute;
    }
  }
  return {};
}

Format format_of_namespace(pugi::xml_node container, const Reader& reader) {
  const pugi::xml_attribute attribute = namespace_of(container);
  const std::string_view value = attribute.value();
  if (value == namespace11) {
    return Format::xdd11;
  }
  if (value != namespace10) {
    reader.findings.add(
        rules::xml_namespace, attribute ? reader.document.span(attribute) : reader.document.tag(container),
        value.empty() ? std::string("namespace is missing") : in_quotes(value) + " is not a namespace of CiA 311",
        "write " + std::string(namespace10));
  }
  return Format::xdd10;
}

Format final_format(const Device& device, std::string_view path) {
  if (device.format != Format::xdd10 && device.format != Format::xdd11) {
    return device.format;
  }
  if (has_ending(path, ".xpd")) {
    return Format::xpd;
  }
  const bool is_configured = device.commissioning.is_given || has_ending(path, ".xdc") || has_ending(path, ".nxdc");
  if (!is_configured) {
    return device.format;
  }
  return device.format == Format::xdd10 ? Format::xdc10 : Format::xdc11;
}

void set_dialect(std::string_view name, std::string_view about, pugi::xml_node root, const Reader& reader) {
  reader.device.dialect = name;
  reader.findings.add(rules::dialect, reader.document.tag(root), "private format: " + std::string(about),
                      "convert it to XDD for other tools");
}

// Reads a part of a body; dialects have such parts at other places, too. ApplicationProcess has already been read.
bool read_part(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader);

void read_parts(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) { return read_part(child, opaque, reader); });
  store_remainder(element, std::move(opaque), others, reader);
}

bool read_part(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (name == "DeviceIdentity") {
    read_identity(child, reader);
  } else if (name == "CANopenObjectList" || name == "ObjectList") {
    read_object_list(child, reader);
  } else if (name == "ApplicationLayers" || name == "TransportLayers" || name == "PhysicalLayer" ||
             name == "ObjectDictionary" || name == "other") {
    read_parts(child, others, reader);
  } else if (name == "file") {
    read_file_info(child, reader);
  } else {
    return name == "ApplicationProcess" || read_network_part(child, others, reader);
  }
  return true;
}

void read_body(pugi::xml_node body, const Reader& reader) {
  read_file_info(body, reader);
  for (const pugi::xml_node child : body.children()) {
    if (child.type() == pugi::node_element && !read_part(child, reader.device.others, reader)) {
      store_opaque(child, reader.device.others, reader);
    }
  }
}

bool is_profile(pugi::xml_node node) {
  const std::string_view name = local_name(node);
  return name == "ISO15745Profile" || name == "Profile" || name == "DeviceProfile";
}

pugi::xml_node child_named(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_node child : node.children()) {
    if (equal_ignoring_case(local_name(child), name)) {
      return child;
    }
  }
  return {};
}

std::vector<pugi::xml_node> children_named(pugi::xml_node node, std::string_view name) {
  std::vector<pugi::xml_node> named;
  for (const pugi::xml_node child : node.children()) {
    if (local_name(child) == name) {
      named.push_back(child);
    }
  }
  return named;
}

void read_profile(pugi::xml_node profile, const Reader& reader) {
  Device& device = reader.device;
  const bool is_network = child_named(child_named(profile, "ProfileBody"), "ApplicationLayers") &&
                          !child_named(child_named(profile, "ProfileBody"), "DeviceIdentity");
  for (const pugi::xml_node child : profile.children()) {
    const std::string_view name = local_name(child);
    if (name == "ProfileHeader") {
      read_header(child, is_network ? device.communication_profile : device.device_profile, reader);
    } else if (name == "ProfileBody") {
      read_body(child, reader);
    } else if (child.type() == pugi::node_element) {
      store_opaque(child, device.others, reader);
    }
  }
}

std::vector<pugi::xml_node> profiles_of(pugi::xml_node container, const Reader& reader) {
  std::vector<pugi::xml_node> profiles;
  if (is_profile(container)) {
    profiles.push_back(container);
  }
  for (const pugi::xml_node child : container.children()) {
    if (is_profile(child)) {
      profiles.push_back(child);
    } else if (child.type() == pugi::node_element && !is_profile(container)) {
      store_opaque(child, reader.device.others, reader);
    }
  }
  return profiles;
}

std::vector<pugi::xml_node> processes_of(const std::vector<pugi::xml_node>& profiles) {
  std::vector<pugi::xml_node> processes;
  for (const pugi::xml_node profile : profiles) {
    for (const pugi::xml_node process : children_named(child_named(profile, "ProfileBody"), "ApplicationProcess")) {
      processes.push_back(process);
    }
  }
  return processes;
}

// Reads a container, or a profile without a container. Reads ApplicationProcess of all profiles first, because objects
// refer to its parameters.
void read_container(pugi::xml_node container, const Reader& reader) {
  const std::vector<pugi::xml_node> profiles = profiles_of(container, reader);
  const std::vector<pugi::xml_node> processes = processes_of(profiles);
  for (const pugi::xml_node process : processes) {
    read_process(process, reader);
  }
  for (const pugi::xml_node profile : profiles) {
    count_references(profile, reader);
  }
  for (const pugi::xml_node profile : profiles) {
    read_profile(profile, reader);
  }
  for (const pugi::xml_node process : processes) {
    for (const pugi::xml_node list : children_named(process, "parameterList")) {
      read_unused_parameters(list, reader);
    }
  }
}

void check_file_name(const Reader& reader) {
  const std::string_view path = reader.document.source().name();
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  const Text& file_name = reader.device.file.file_name;
  if (!file_name.is_empty() && file_name.text != name && name != "<stdin>") {
    reader.findings.add(rules::file_name, file_name.span,
                        "fileName is " + in_quotes(file_name.text) + ", but the file is named " + in_quotes(name),
                        "correct fileName, or rename the file");
  }
}

void read_device(pugi::xml_node element, Dialect dialect, const Document& document, Description& description,
                 Findings& findings) {
  Device& device = description.devices.emplace_back();
  Shared shared;
  shared.dialect = dialect;
  shared.copies_left = document.source().size() + std::size_t{100000};
  const Reader reader{document, device, findings, shared};
  device.format = Format::other_xml;
  switch (dialect) {
    case Dialect::container:
    case Dialect::project: device.format = format_of_namespace(element, reader); break;
    case Dialect::maxon:
      set_dialect(document.source().bytes().find("ELTRA") != std::string_view::npos ? "eltra" : "maxon",
                  "a description as maxon has it: parameters with an index", element, reader);
      break;
    case Dialect::device_profile:
      set_dialect("DeviceProfile", "DeviceProfile with elements instead of attributes", element, reader);
      break;
    case Dialect::canopennode:
      device.format = Format::project_xml;
      set_dialect("CANopenNode", "_project.xml of an old CANopenNode", element, reader);
      break;
    case Dialect::none: break;
  }
  if (dialect == Dialect::canopennode) {
    read_parts(element, device.others, reader);
  } else {
    read_container(element, reader);
  }
  finish_objects(reader);
  check_file_name(reader);
  device.format = final_format(device, document.source().name());
}

// Reads the containers of an .nxdd, which are some levels below the root.
void read_project(pugi::xml_node element, const Document& document, Description& description, Findings& findings,
                  unsigned levels) {
  for (const pugi::xml_node child : element.children()) {
    if (local_name(child) == "ISO15745ProfileContainer") {
      read_device(child, Dialect::container, document, description, findings);
      description.devices.back().format = Format::nxdd;
    } else if (levels != 0) {
      read_project(child, document, description, findings, levels - 1);
    }
  }
}

}  // namespace

Description read(Document& document, Findings& findings) {
  Description description;
  const Dialect dialect = dialect_of(document.root());
  if (dialect == Dialect::project) {
    read_project(document.root(), document, description, findings, 3);
  }
  if (description.devices.empty()) {
    read_device(document.root(), dialect, document, description, findings);
  }
  document.release();
  findings.sort();
  return description;
}

}  // namespace lexican::codict::xdd
