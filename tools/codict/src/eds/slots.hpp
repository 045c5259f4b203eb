// SPDX-License-Identifier: Apache-2.0
/// \file slots.hpp
/// Tables of the keys of CiA 306, in the order in which they are written, with their members in the model.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "eds/fields.hpp"
#include "model/device.hpp"

namespace lexican::codict::eds {

/// Returns the first order code, which is the only one of an EDS. Adds an empty one if there is none.
inline Text& order_code(Device& device) {
  std::vector<Text>& codes = device.identity.order_codes;
  return codes.empty() ? codes.emplace_back() : codes.front();
}

inline constexpr std::array<Slot<FileInfo>, 12> file_slots = {{
    {"FileName", [](FileInfo& f) -> Text& { return f.file_name; }},
    {"FileVersion", [](FileInfo& f) -> Text& { return f.version; }},
    {"FileRevision", [](FileInfo& f) -> Text& { return f.revision; }},
    {"EDSVersion", [](FileInfo& f) -> Text& { return f.eds_version; }},
    {"Description", [](FileInfo& f) -> Text& { return f.description; }, 243},
    {"CreationTime", [](FileInfo& f) -> Text& { return f.creation_time; }},
    {"CreationDate", [](FileInfo& f) -> Text& { return f.creation_date; }},
    {"CreatedBy", [](FileInfo& f) -> Text& { return f.created_by; }, 245},
    {"ModificationTime", [](FileInfo& f) -> Text& { return f.modification_time; }},
    {"ModificationDate", [](FileInfo& f) -> Text& { return f.modification_date; }},
    {"ModifiedBy", [](FileInfo& f) -> Text& { return f.modified_by; }, 244},
    {"LastEDS", [](FileInfo& f) -> Text& { return f.last_eds; }},
}};

inline constexpr std::array<Slot<Device>, 21> device_slots = {{
    {"VendorName", [](Device& d) -> Text& { return d.identity.vendor_name; }, 244},
    {"VendorNumber", [](Device& d) -> Text& { return d.identity.vendor_number; }},
    {"ProductName", [](Device& d) -> Text& { return d.identity.product_name; }, 243},
    {"ProductNumber", [](Device& d) -> Text& { return d.identity.product_number; }},
    {"RevisionNumber", [](Device& d) -> Text& { return d.identity.revision_number; }},
    {"OrderCode", order_code, 245},
    {"SimpleBootUpMaster", [](Device& d) -> Text& { return d.features.boot_up_master; }},
    {"SimpleBootUpSlave", [](Device& d) -> Text& { return d.features.boot_up_slave; }},
    {"ExtendedBootUpMaster", [](Device& d) -> Text& { return d.features.extended_boot_up_master; }},
    {"ExtendedBootUpSlave", [](Device& d) -> Text& { return d.features.extended_boot_up_slave; }},
    {"Granularity", [](Device& d) -> Text& { return d.features.granularity; }},
    {"DynamicChannelsSupported", [](Device& d) -> Text& { return d.features.dynamic_channels; }},
    {"GroupMessaging", [](Device& d) -> Text& { return d.features.group_messaging; }},
    {"NrOfRXPDO", [](Device& d) -> Text& { return d.features.rx_pdos; }},
    {"NrOfTXPDO", [](Device& d) -> Text& { return d.features.tx_pdos; }},
    {"LSS_Supported", [](Device& d) -> Text& { return d.features.lss_slave; }},
    {"LSS_Master", [](Device& d) -> Text& { return d.features.lss_master; }},
    {"CompactPDO", [](Device& d) -> Text& { return d.features.compact_pdo; }},
    {"NG_Slave", [](Device& d) -> Text& { return d.features.node_guarding_slave; }},
    {"NG_Master", [](Device& d) -> Text& { return d.features.node_guarding_master; }},
    {"NrOfNG_MonitoredNodes", [](Device& d) -> Text& { return d.features.guarded_nodes; }},
}};

inline constexpr std::array<Slot<Commissioning>, 9> commissioning_slots = {{
    {"NodeID", [](Commissioning& c) -> Text& { return c.node_id; }},
    {"NodeName", [](Commissioning& c) -> Text& { return c.node_name; }, 246},
    {"Baudrate", [](Commissioning& c) -> Text& { return c.bit_rate; }},
    {"NetNumber", [](Commissioning& c) -> Text& { return c.network_number; }},
    {"NetworkName", [](Commissioning& c) -> Text& { return c.network_name; }, 243},
    {"CANopenManager", [](Commissioning& c) -> Text& { return c.is_manager; }},
    {"LSS_SerialNumber", [](Commissioning& c) -> Text& { return c.serial_number; }},
    {"NodeRefd", [](Commissioning& c) -> Text& { return c.node_reference; }},
    {"NetRefd", [](Commissioning& c) -> Text& { return c.network_reference; }},
}};

inline constexpr std::array<Slot<Entry>, 14> entry_slots = {{
    {"ParameterName", [](Entry& e) -> Text& { return e.name; }, 241},
    {"ObjectType", [](Entry& e) -> Text& { return e.object_code; }},
    {"DataType", [](Entry& e) -> Text& { return e.data_type; }},
    {"AccessType", [](Entry& e) -> Text& { return e.access; }},
    {"DefaultValue", [](Entry& e) -> Text& { return e.default_value; }},
    {"PDOMapping", [](Entry& e) -> Text& { return e.pdo_mapping; }},
    {"LowLimit", [](Entry& e) -> Text& { return e.low_limit.edit(); }},
    {"HighLimit", [](Entry& e) -> Text& { return e.high_limit.edit(); }},
    {"ObjFlags", [](Entry& e) -> Text& { return e.flags.edit(); }},
    {"ParameterValue", [](Entry& e) -> Text& { return e.actual_value.edit(); }},
    {"Denotation", [](Entry& e) -> Text& { return e.denotation.edit(); }},
    {"UploadFile", [](Entry& e) -> Text& { return e.upload_file.edit(); }, 244},
    {"DownloadFile", [](Entry& e) -> Text& { return e.download_file.edit(); }, 242},
    {"ParamRefd", [](Entry& e) -> Text& { return e.parameter_reference.edit(); }},
}};

inline constexpr std::array<Slot<Object>, 2> object_slots = {{
    {"SubNumber", [](Object& o) -> Text& { return o.sub_number; }},
    {"CompactSubObj", [](Object& o) -> Text& { return o.compact; }},
}};

inline constexpr std::array<Slot<Module>, 4> module_slots = {{
    {"ProductName", [](Module& m) -> Text& { return m.product_name; }},
    {"ProductVersion", [](Module& m) -> Text& { return m.product_version; }},
    {"ProductRevision", [](Module& m) -> Text& { return m.product_revision; }},
    {"OrderCode", [](Module& m) -> Text& { return m.order_code; }},
}};

inline constexpr std::array<Slot<SubExtension>, 2> extension_slots = {{
    {"Count", [](SubExtension& e) -> Text& { return e.count; }},
    {"ObjExtend", [](SubExtension& e) -> Text& { return e.object_extension; }},
}};

/// Returns the text of the first label. Adds an empty label if there is none.
inline Text& first_of(std::vector<Label>& labels) {
  return labels.empty() ? labels.emplace_back().text : labels.front().text;
}

/// Keys that python-canopen adds to CiA 306.
inline constexpr std::array<Slot<Entry>, 3> python_slots = {{
    {"Unit", [](Entry& e) -> Text& { return first_of(e.unit.edit().texts.labels); }},
    {"Factor", [](Entry& e) -> Text& { return e.multiplier.edit(); }},
    {"Description", [](Entry& e) -> Text& { return first_of(e.texts.edit().descriptions); }},
}};
inline constexpr std::string_view python_dialect = "python-canopen";

/// Calls `call` for each flag that is 0 or 1 in an EDS and may be true or false in other formats.
template <typename Features, typename Call>
void for_each_flag(Features& features, Call call) {
  for (auto* flag : {&features.boot_up_master, &features.boot_up_slave, &features.extended_boot_up_master,
                     &features.extended_boot_up_slave, &features.group_messaging, &features.lss_slave,
                     &features.lss_master, &features.node_guarding_slave, &features.node_guarding_master}) {
    call(*flag);
  }
}

}  // namespace lexican::codict::eds
