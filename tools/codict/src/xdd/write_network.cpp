// SPDX-License-Identifier: Apache-2.0
// Writes ApplicationLayers without the objects, TransportLayers and NetworkManagement. [311]
#include <algorithm>

#include "model/parse.hpp"
#include "xdd/writer.hpp"

namespace lexican::codict::xdd {

namespace {

std::string_view word(bool value) { return value ? "true" : "false"; }

std::string rate_text(std::uint32_t kbit) { return kbit == 0 ? "auto-baudRate" : std::to_string(kbit) + " Kbps"; }

// Returns the text `meant`, or the original text of a field if that is malformed.
template <typename T>
std::string text_or(const Field<T>& field, std::string_view meant) {
  return std::string(field.is_empty() || is_understood(field) ? meant : field.text);
}

template <typename T>
void print_number(Printer& out, std::string_view name, const Field<T>& field) {
  if (field.is_given) {
    out.attribute(name, std::string_view(text_or(field, std::to_string(field.value))));
  }
}

void print_flag(Printer& out, std::string_view name, const Field<bool>& field) {
  if (field.is_given) {
    out.attribute(name, std::string_view(text_or(field, word(field.value))));
  }
}

template <typename T>
void print_hex(Printer& out, std::string_view name, const Field<T>& field, std::size_t digits) {
  out.attribute(name, std::string_view(text_or(field, hex(field.value, digits))));
}

void print_rates(Printer& out, const Features& features, const OpaquePart* remainder) {
  OpaqueParts opaque = parts_inside(remainder);
  out.open("baudRate");
  if (const Field<std::uint32_t>& rate = features.default_bit_rate; rate.is_given) {
    out.attribute("defaultValue", std::string_view(rate.is_empty() ? "" : text_or(rate, rate_text(rate.value))));
  }
  out.attributes_of(opaque);
  for (const BitRate& rate : features.bit_rates) {
    // A malformed bit rate has only a text.
    if (rate.supported.value || rate.kbit == 0) {
      out.open("supportedBaudRate");
      out.attribute("value", std::string_view(rate.supported.value ? rate_text(rate.kbit) : rate.supported.text));
      out.close();
    }
  }
  out.elements_of(opaque);
  out.close();
}

void print_general(Printer& out, const Features& f, const OpaquePart* remainder) {
  out.open("CANopenGeneralFeatures");
  print_flag(out, "groupMessaging", f.group_messaging);
  print_number(out, "dynamicChannels", f.dynamic_channels);
  print_flag(out, "selfStartingDevice", f.self_starting);
  print_flag(out, "SDORequestingDevice", f.sdo_requesting);
  out.attribute("granularity", std::string_view(text_or(f.granularity, std::to_string(f.granularity.value))));
  print_number(out, "nrOfRxPDO", f.rx_pdos);
  print_number(out, "nrOfTxPDO", f.tx_pdos);
  print_flag(out, "bootUpSlave", f.boot_up_slave);
  print_flag(out, "layerSettingServiceSlave", f.lss_slave);
  print_flag(out, "ngSlave", f.node_guarding_slave);
  print_flag(out, "ngMaster", f.node_guarding_master);
  print_number(out, "NrOfNG_MonitoredNodes", f.guarded_nodes);
  out.attributes_of(parts_inside(remainder));
  out.elements_of(parts_inside(remainder));
  out.close();
}

void print_master(Printer& out, const Features& f, const OpaquePart* remainder) {
  out.open("CANopenMasterFeatures");
  print_flag(out, "bootUpMaster", f.boot_up_master);
  print_flag(out, "flyingMaster", f.flying_master);
  print_flag(out, "SDOManager", f.sdo_manager);
  print_flag(out, "configurationManager", f.configuration_manager);
  print_flag(out, "layerSettingServiceMaster", f.lss_master);
  out.attributes_of(parts_inside(remainder));
  out.elements_of(parts_inside(remainder));
  out.close();
}

void print_commissioning(Printer& out, const Commissioning& c, const OpaquePart* remainder) {
  out.open("deviceCommissioning");
  if (!c.node_id.is_empty()) {
    print_number(out, "nodeID", c.node_id);
  }
  out.attribute("nodeName", std::string_view(c.node_name.text));
  const std::string rate = c.bit_rate.is_empty() ? "" : rate_text(c.bit_rate.value);
  out.attribute("actualBaudRate", std::string_view(text_or(c.bit_rate, rate)));
  out.attribute("networkNumber", std::string_view(text_or(c.network_number, std::to_string(c.network_number.value))));
  out.attribute("networkName", std::string_view(c.network_name.text));
  out.attribute("CANopenManager", std::string_view(text_or(c.is_manager, word(c.is_manager.value))));
  out.attributes_of(parts_inside(remainder));
  out.elements_of(parts_inside(remainder));
  out.close();
}

std::string_view direction(Access access) {
  switch (access) {
    case Access::ro: return "readOnly";
    case Access::wo: return "writeOnly";
    default: return "readWriteOutput";
  }
}

}  // namespace

void print_transport(Printer& out, const Device& device, const OpaquePart* remainder,
                     const OpaquePart* rates_remainder) {
  OpaqueParts opaque = parts_inside(remainder);
  const OpaquePart* const physical = opaque.remove_first("PhysicalLayer");
  OpaqueParts of_physical = parts_inside(physical);
  const OpaquePart* const of_rates = of_physical.remove_first("baudRate");
  out.open("TransportLayers");
  out.open("PhysicalLayer");
  print_rates(out, device.features, of_rates != nullptr ? of_rates : rates_remainder);
  out.elements_of(of_physical);
  out.close();
  out.elements_of(opaque);
  out.close();
}

void print_management(Printer& out, const Device& device, const OpaquePart* remainder) {
  OpaqueParts opaque = parts_inside(remainder);
  out.open("NetworkManagement");
  print_general(out, device.features, opaque.remove_first("CANopenGeneralFeatures"));
  print_master(out, device.features, opaque.remove_first("CANopenMasterFeatures"));
  if (device.commissioning.is_given) {
    print_commissioning(out, device.commissioning, opaque.remove_first("deviceCommissioning"));
  }
  out.elements_of(opaque);
  out.close();
}

void print_dummies(Printer& out, const Device& device, const OpaquePart* remainder) {
  if (device.dummies.empty() && remainder == nullptr) {
    return;
  }
  out.open("dummyUsage");
  for (const Dummy& dummy : device.dummies) {
    out.open("dummy");
    out.attribute("entry",
                  "Dummy" + hex(dummy.type, 4) + "=" + text_or(dummy.supported, dummy.supported.value ? "1" : "0"));
    out.close();
  }
  out.elements_of(parts_inside(remainder));
  out.close();
}

void print_channels(Printer& out, const Device& device, const OpaquePart* remainder) {
  if (device.dynamic_channels.empty() && remainder == nullptr) {
    return;
  }
  out.open("dynamicChannels");
  for (const DynamicChannel& channel : device.dynamic_channels) {
    out.open("dynamicChannel");
    const OpaqueParts opaque(channel.others);
    print_hex(out, "dataType", channel.data_type, 2);
    out.attribute("accessType", direction(channel.access.value));
    print_hex(out, "startIndex", channel.first_index, 4);
    print_hex(out, "endIndex", channel.last_index, 4);
    print_number(out, "maxNumber", channel.max_number);
    if (channel.offset.is_given) {
      print_hex(out, "addressOffset", channel.offset, 4);
    }
    print_number(out, "bitAlignment", channel.bit_alignment);
    out.attributes_of(opaque);
    out.elements_of(opaque);
    out.close();
  }
  out.elements_of(parts_inside(remainder));
  out.close();
}

}  // namespace lexican::codict::xdd
