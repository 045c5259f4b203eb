// Made by codict gen from clock.xdd: do not edit.
/// \file clock_od.h
/// An object dictionary.
#ifndef CLOCK_OD_H_
#define CLOCK_OD_H_

#include "co_core.h"

#if !USE_EMCY
#error "clock: the dictionary needs USE_EMCY (co_cfg.h)"
#endif
#if !USE_PARA
#error "clock: the dictionary needs USE_PARA (co_cfg.h)"
#endif
#if !USE_SYNC
#error "clock: the dictionary needs USE_SYNC (co_cfg.h)"
#endif
#if CO_RPDO_N < 1
#error "clock: the description has RPDO 1, CO_RPDO_N is less: set CO_RPDO_N to 1 (co_cfg.h, -DCO_RPDO_N=1)"
#endif
#if CO_SSDO_N < 1
#error "clock: the description has SDO server 1, CO_SSDO_N is less: set CO_SSDO_N to 1 (co_cfg.h, -DCO_SSDO_N=1)"
#endif
#if CO_TPDO_N < 1
#error "clock: the description has TPDO 1, CO_TPDO_N is less: set CO_TPDO_N to 1 (co_cfg.h, -DCO_TPDO_N=1)"
#endif
#define CLOCK_OD_RPDO_N 1  ///< of co_cfg.h, at least
#define CLOCK_OD_SSDO_N 1  ///< of co_cfg.h, at least
#define CLOCK_OD_TPDO_N 1  ///< of co_cfg.h, at least

#define CLOCK_OD_NUM 55  ///< entries and end mark: CO_NODE_SPEC.DictLen

/// \name Keys of the entries
/// \{
#define CLOCK_1000_0 CO_DEV(0x1000, 0x00)  ///< Device type, UNSIGNED32 const
#define CLOCK_DEVICE_TYPE CLOCK_1000_0
#define CLOCK_1001_0 CO_DEV(0x1001, 0x00)  ///< Error register, UNSIGNED8 ro
#define CLOCK_ERROR_REGISTER CLOCK_1001_0
#define CLOCK_1003_0 CO_DEV(0x1003, 0x00)  ///< Pre-defined error field Number of errors, UNSIGNED8 rw
#define CLOCK_PRE_DEFINED_ERROR_FIELD_NUMBER_OF_ERRORS CLOCK_1003_0
#define CLOCK_1003_1 CO_DEV(0x1003, 0x01)  ///< Pre-defined error field Standard error field 1, UNSIGNED32 ro
#define CLOCK_PRE_DEFINED_ERROR_FIELD_STANDARD_ERROR_FIELD_1 CLOCK_1003_1
#define CLOCK_1003_2 CO_DEV(0x1003, 0x02)  ///< Pre-defined error field Standard error field 2, UNSIGNED32 ro
#define CLOCK_PRE_DEFINED_ERROR_FIELD_STANDARD_ERROR_FIELD_2 CLOCK_1003_2
#define CLOCK_1003_3 CO_DEV(0x1003, 0x03)  ///< Pre-defined error field Standard error field 3, UNSIGNED32 ro
#define CLOCK_PRE_DEFINED_ERROR_FIELD_STANDARD_ERROR_FIELD_3 CLOCK_1003_3
#define CLOCK_1003_4 CO_DEV(0x1003, 0x04)  ///< Pre-defined error field Standard error field 4, UNSIGNED32 ro
#define CLOCK_PRE_DEFINED_ERROR_FIELD_STANDARD_ERROR_FIELD_4 CLOCK_1003_4
#define CLOCK_1005_0 CO_DEV(0x1005, 0x00)  ///< COB-ID SYNC message, UNSIGNED32 rw
#define CLOCK_COB_ID_SYNC_MESSAGE CLOCK_1005_0
#define CLOCK_1006_0 CO_DEV(0x1006, 0x00)  ///< Communication cycle period, UNSIGNED32 rw
#define CLOCK_COMMUNICATION_CYCLE_PERIOD CLOCK_1006_0
#define CLOCK_1008_0 CO_DEV(0x1008, 0x00)  ///< Manufacturer device name, VISIBLE_STRING const
#define CLOCK_MANUFACTURER_DEVICE_NAME CLOCK_1008_0
#define CLOCK_1009_0 CO_DEV(0x1009, 0x00)  ///< Manufacturer hardware version, VISIBLE_STRING const
#define CLOCK_MANUFACTURER_HARDWARE_VERSION CLOCK_1009_0
#define CLOCK_100A_0 CO_DEV(0x100A, 0x00)  ///< Manufacturer software version, VISIBLE_STRING const
#define CLOCK_MANUFACTURER_SOFTWARE_VERSION CLOCK_100A_0
#define CLOCK_100C_0 CO_DEV(0x100C, 0x00)  ///< Guard time, UNSIGNED16 rw
#define CLOCK_GUARD_TIME CLOCK_100C_0
#define CLOCK_100D_0 CO_DEV(0x100D, 0x00)  ///< Life time factor, UNSIGNED8 rw
#define CLOCK_LIFE_TIME_FACTOR CLOCK_100D_0
#define CLOCK_1010_0 CO_DEV(0x1010, 0x00)  ///< Store parameters Highest sub-index supported, UNSIGNED8 const
#define CLOCK_STORE_PARAMETERS_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1010_0
#define CLOCK_1010_1 CO_DEV(0x1010, 0x01)  ///< Store parameters Save all parameters, UNSIGNED32 rw
#define CLOCK_STORE_PARAMETERS_SAVE_ALL_PARAMETERS CLOCK_1010_1
#define CLOCK_1011_0 CO_DEV(0x1011, 0x00)  ///< Restore default parameters Highest sub-index supported, UNSIGNED8 const
#define CLOCK_RESTORE_DEFAULT_PARAMETERS_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1011_0
#define CLOCK_1011_1 CO_DEV(0x1011, 0x01)  ///< Restore default parameters Restore all default parameters, UNSIGNED32 rw
#define CLOCK_RESTORE_DEFAULT_PARAMETERS_RESTORE_ALL_DEFAULT_PARAMETERS CLOCK_1011_1
#define CLOCK_1014_0 CO_DEV(0x1014, 0x00)  ///< COB-ID EMCY, UNSIGNED32 const
#define CLOCK_COB_ID_EMCY CLOCK_1014_0
#define CLOCK_1017_0 CO_DEV(0x1017, 0x00)  ///< Producer heartbeat time, UNSIGNED16 rw
#define CLOCK_PRODUCER_HEARTBEAT_TIME CLOCK_1017_0
#define CLOCK_1018_0 CO_DEV(0x1018, 0x00)  ///< Identity object Highest sub-index supported, UNSIGNED8 const
#define CLOCK_IDENTITY_OBJECT_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1018_0
#define CLOCK_1018_1 CO_DEV(0x1018, 0x01)  ///< Identity object Vendor-ID, UNSIGNED32 ro
#define CLOCK_IDENTITY_OBJECT_VENDOR_ID CLOCK_1018_1
#define CLOCK_1018_2 CO_DEV(0x1018, 0x02)  ///< Identity object Product code, UNSIGNED32 ro
#define CLOCK_IDENTITY_OBJECT_PRODUCT_CODE CLOCK_1018_2
#define CLOCK_1018_3 CO_DEV(0x1018, 0x03)  ///< Identity object Revision number, UNSIGNED32 ro
#define CLOCK_IDENTITY_OBJECT_REVISION_NUMBER CLOCK_1018_3
#define CLOCK_1018_4 CO_DEV(0x1018, 0x04)  ///< Identity object Serial number, UNSIGNED32 ro
#define CLOCK_IDENTITY_OBJECT_SERIAL_NUMBER CLOCK_1018_4
#define CLOCK_1020_0 CO_DEV(0x1020, 0x00)  ///< Verify configuration Highest sub-index supported, UNSIGNED8 const
#define CLOCK_VERIFY_CONFIGURATION_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1020_0
#define CLOCK_1020_1 CO_DEV(0x1020, 0x01)  ///< Verify configuration Configuration date, UNSIGNED32 rw
#define CLOCK_VERIFY_CONFIGURATION_CONFIGURATION_DATE CLOCK_1020_1
#define CLOCK_1020_2 CO_DEV(0x1020, 0x02)  ///< Verify configuration Configuration time, UNSIGNED32 rw
#define CLOCK_VERIFY_CONFIGURATION_CONFIGURATION_TIME CLOCK_1020_2
#define CLOCK_1200_0 CO_DEV(0x1200, 0x00)  ///< SDO server parameter Highest sub-index supported, UNSIGNED8 const
#define CLOCK_SDO_SERVER_PARAMETER_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1200_0
#define CLOCK_1200_1 CO_DEV(0x1200, 0x01)  ///< SDO server parameter COB-ID client to server, UNSIGNED32 ro
#define CLOCK_SDO_SERVER_PARAMETER_COB_ID_CLIENT_TO_SERVER CLOCK_1200_1
#define CLOCK_1200_2 CO_DEV(0x1200, 0x02)  ///< SDO server parameter COB-ID server to client, UNSIGNED32 ro
#define CLOCK_SDO_SERVER_PARAMETER_COB_ID_SERVER_TO_CLIENT CLOCK_1200_2
#define CLOCK_1400_0 CO_DEV(0x1400, 0x00)  ///< RPDO communication parameter Highest sub-index supported, UNSIGNED8 const
#define CLOCK_RPDO_COMMUNICATION_PARAMETER_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1400_0
#define CLOCK_1400_1 CO_DEV(0x1400, 0x01)  ///< RPDO communication parameter COB-ID, UNSIGNED32 ro
#define CLOCK_RPDO_COMMUNICATION_PARAMETER_COB_ID CLOCK_1400_1
#define CLOCK_1400_2 CO_DEV(0x1400, 0x02)  ///< RPDO communication parameter Transmission type, UNSIGNED8 rw
#define CLOCK_RPDO_COMMUNICATION_PARAMETER_TRANSMISSION_TYPE CLOCK_1400_2
#define CLOCK_1600_0 CO_DEV(0x1600, 0x00)  ///< RPDO mapping parameter Number of mapped objects, UNSIGNED8 const
#define CLOCK_RPDO_MAPPING_PARAMETER_NUMBER_OF_MAPPED_OBJECTS CLOCK_1600_0
#define CLOCK_1600_1 CO_DEV(0x1600, 0x01)  ///< RPDO mapping parameter Mapped object 1, UNSIGNED32 const
#define CLOCK_RPDO_MAPPING_PARAMETER_MAPPED_OBJECT_1 CLOCK_1600_1
#define CLOCK_1600_2 CO_DEV(0x1600, 0x02)  ///< RPDO mapping parameter Mapped object 2, UNSIGNED32 const
#define CLOCK_RPDO_MAPPING_PARAMETER_MAPPED_OBJECT_2 CLOCK_1600_2
#define CLOCK_1600_3 CO_DEV(0x1600, 0x03)  ///< RPDO mapping parameter Mapped object 3, UNSIGNED32 const
#define CLOCK_RPDO_MAPPING_PARAMETER_MAPPED_OBJECT_3 CLOCK_1600_3
#define CLOCK_1800_0 CO_DEV(0x1800, 0x00)  ///< TPDO communication parameter Highest sub-index supported, UNSIGNED8 const
#define CLOCK_TPDO_COMMUNICATION_PARAMETER_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_1800_0
#define CLOCK_1800_1 CO_DEV(0x1800, 0x01)  ///< TPDO communication parameter COB-ID, UNSIGNED32 ro
#define CLOCK_TPDO_COMMUNICATION_PARAMETER_COB_ID CLOCK_1800_1
#define CLOCK_1800_2 CO_DEV(0x1800, 0x02)  ///< TPDO communication parameter Transmission type, UNSIGNED8 rw
#define CLOCK_TPDO_COMMUNICATION_PARAMETER_TRANSMISSION_TYPE CLOCK_1800_2
#define CLOCK_1800_3 CO_DEV(0x1800, 0x03)  ///< TPDO communication parameter Inhibit time, UNSIGNED16 rw
#define CLOCK_TPDO_COMMUNICATION_PARAMETER_INHIBIT_TIME CLOCK_1800_3
#define CLOCK_1800_5 CO_DEV(0x1800, 0x05)  ///< TPDO communication parameter Event timer, UNSIGNED16 rw
#define CLOCK_TPDO_COMMUNICATION_PARAMETER_EVENT_TIMER CLOCK_1800_5
#define CLOCK_1A00_0 CO_DEV(0x1A00, 0x00)  ///< TPDO mapping parameter Number of mapped objects, UNSIGNED8 const
#define CLOCK_TPDO_MAPPING_PARAMETER_NUMBER_OF_MAPPED_OBJECTS CLOCK_1A00_0
#define CLOCK_1A00_1 CO_DEV(0x1A00, 0x01)  ///< TPDO mapping parameter Mapped object 1, UNSIGNED32 const
#define CLOCK_TPDO_MAPPING_PARAMETER_MAPPED_OBJECT_1 CLOCK_1A00_1
#define CLOCK_1A00_2 CO_DEV(0x1A00, 0x02)  ///< TPDO mapping parameter Mapped object 2, UNSIGNED32 const
#define CLOCK_TPDO_MAPPING_PARAMETER_MAPPED_OBJECT_2 CLOCK_1A00_2
#define CLOCK_1A00_3 CO_DEV(0x1A00, 0x03)  ///< TPDO mapping parameter Mapped object 3, UNSIGNED32 const
#define CLOCK_TPDO_MAPPING_PARAMETER_MAPPED_OBJECT_3 CLOCK_1A00_3
#define CLOCK_2100_0 CO_DEV(0x2100, 0x00)  ///< Time Highest sub-index supported, UNSIGNED8 const
#define CLOCK_TIME_HIGHEST_SUB_INDEX_SUPPORTED CLOCK_2100_0
#define CLOCK_2100_1 CO_DEV(0x2100, 0x01)  ///< Time Hour, UNSIGNED8 rw
#define CLOCK_TIME_HOUR CLOCK_2100_1
#define CLOCK_2100_2 CO_DEV(0x2100, 0x02)  ///< Time Minute, UNSIGNED8 rw
#define CLOCK_TIME_MINUTE CLOCK_2100_2
#define CLOCK_2100_3 CO_DEV(0x2100, 0x03)  ///< Time Second, UNSIGNED8 rw
#define CLOCK_TIME_SECOND CLOCK_2100_3
#define CLOCK_2101_0 CO_DEV(0x2101, 0x00)  ///< Time zone, INTEGER16 rw
#define CLOCK_TIME_ZONE CLOCK_2101_0
#define CLOCK_2200_0 CO_DEV(0x2200, 0x00)  ///< Picture, DOMAIN rw
#define CLOCK_PICTURE CLOCK_2200_0
#define CLOCK_2201_0 CO_DEV(0x2201, 0x00)  ///< Station name, VISIBLE_STRING rw
#define CLOCK_STATION_NAME CLOCK_2201_0
/// \}

#ifdef __cplusplus
extern "C" {
#endif

/// Variables that are not stored. CONodeInit() gives them their default values; NMT resets do so for those
/// that the network can write.
typedef struct clock_ram_t_ {
  union { CO_OBJ_STR od_1008_0; CO_OBJ_STR manufacturer_device_name; };  ///< Manufacturer device name, VISIBLE_STRING const
  union { uint32_t od_1003_1; uint32_t pre_defined_error_field_standard_error_field_1; };  ///< Pre-defined error field Standard error field 1, UNSIGNED32 ro
  union { uint32_t od_1003_2; uint32_t pre_defined_error_field_standard_error_field_2; };  ///< Pre-defined error field Standard error field 2, UNSIGNED32 ro
  union { uint32_t od_1003_3; uint32_t pre_defined_error_field_standard_error_field_3; };  ///< Pre-defined error field Standard error field 3, UNSIGNED32 ro
  union { uint32_t od_1003_4; uint32_t pre_defined_error_field_standard_error_field_4; };  ///< Pre-defined error field Standard error field 4, UNSIGNED32 ro
  union { uint32_t od_1018_4; uint32_t identity_object_serial_number; };  ///< Identity object Serial number, UNSIGNED32 ro
  union { uint8_t od_1001_0; uint8_t error_register; };  ///< Error register, UNSIGNED8 ro
  union { uint8_t od_1003_0; uint8_t pre_defined_error_field_number_of_errors; };  ///< Pre-defined error field Number of errors, UNSIGNED8 rw
  union { uint8_t od_2100_1; uint8_t time_hour; };  ///< Time Hour, UNSIGNED8 rw
  union { uint8_t od_2100_2; uint8_t time_minute; };  ///< Time Minute, UNSIGNED8 rw
  union { uint8_t od_2100_3; uint8_t time_second; };  ///< Time Second, UNSIGNED8 rw
  union { uint32_t od_1005_0; uint32_t cob_id_sync_message; };  ///< COB-ID SYNC message, UNSIGNED32 rw
  union { uint32_t od_1006_0; uint32_t communication_cycle_period; };  ///< Communication cycle period, UNSIGNED32 rw
  union { uint16_t od_100C_0; uint16_t guard_time; };  ///< Guard time, UNSIGNED16 rw
  union { uint16_t od_1017_0; uint16_t producer_heartbeat_time; };  ///< Producer heartbeat time, UNSIGNED16 rw
  union { uint16_t od_1800_3; uint16_t tpdo_communication_parameter_inhibit_time; };  ///< TPDO communication parameter Inhibit time, UNSIGNED16 rw
  union { uint16_t od_1800_5; uint16_t tpdo_communication_parameter_event_timer; };  ///< TPDO communication parameter Event timer, UNSIGNED16 rw
  union { uint8_t od_100D_0; uint8_t life_time_factor; };  ///< Life time factor, UNSIGNED8 rw
  union { uint8_t od_1400_2; uint8_t rpdo_communication_parameter_transmission_type; };  ///< RPDO communication parameter Transmission type, UNSIGNED8 rw
  union { uint8_t od_1800_2; uint8_t tpdo_communication_parameter_transmission_type; };  ///< TPDO communication parameter Transmission type, UNSIGNED8 rw
} clock_ram_t;
extern clock_ram_t clock_ram;

/// Storage group SETTINGS, 1010h sub 1. CONodeInit() fills it.
typedef struct clock_settings_t_ {
  union { uint32_t od_1020_1; uint32_t verify_configuration_configuration_date; };  ///< Verify configuration Configuration date, UNSIGNED32 rw
  union { uint32_t od_1020_2; uint32_t verify_configuration_configuration_time; };  ///< Verify configuration Configuration time, UNSIGNED32 rw
  uint32_t od_2201_0_length;
  union { int16_t od_2101_0; int16_t time_zone; };  ///< Time zone, INTEGER16 rw
  union { uint8_t od_2201_0[33]; uint8_t station_name[33]; };  ///< Station name, VISIBLE_STRING rw
  uint8_t unused[1];
} clock_settings_t;
extern clock_settings_t clock_settings;
#define CLOCK_SETTINGS_LAYOUT 0xEFBE21u  ///< hash of its entries, their types and sizes: CO_PARA_VERSION()
extern const CO_PARA clock_settings_para;

/// \name Where the groups lie in the memory that is not volatile: from a byte on, and its larger of
/// ProgramSize and EraseSize, and its ProgramSize (co_if_nvm.h). Another memory: define them for the source
/// file and the application.
/// \{
#ifndef CLOCK_PARA_BASE
#define CLOCK_PARA_BASE 0u
#endif
#ifndef CLOCK_PARA_UNIT
#define CLOCK_PARA_UNIT 1u
#endif
#ifndef CLOCK_PARA_PROGRAM
#define CLOCK_PARA_PROGRAM 1u
#endif
#define CLOCK_SETTINGS_OFFSET CLOCK_PARA_BASE
#define CLOCK_SETTINGS_END (CLOCK_SETTINGS_OFFSET + CO_PARA_SPACE(sizeof(clock_settings_t), CLOCK_PARA_UNIT, CLOCK_PARA_PROGRAM))
#define CLOCK_PARA_END CLOCK_SETTINGS_END  ///< behind the last group
/// \}

/// Gives all variables their default values, for an application that uses them before CONodeInit(). Those that
/// the network cannot write then keep what the application writes to them.
void clock_set_defaults(void);

/// \name To be defined by the application
/// \{
extern CO_OBJ_STR clock_1009_0;
extern CO_OBJ_STR clock_100A_0;
extern const CO_OBJ_TYPE clock_2100_1_type;
extern const CO_OBJ_TYPE clock_2100_2_type;
extern const CO_OBJ_TYPE clock_2100_3_type;
extern CO_OBJ_DOM clock_2200_0;
/// \}

/// The dictionary: CO_NODE_SPEC.Dict = (CO_OBJ *)clock_od.
extern const CO_OBJ clock_od[CLOCK_OD_NUM];

#ifdef __cplusplus
}
#endif

#ifdef __cplusplus
#include "co/object.hpp"

/// Entries as values of their C++ types: clock_objects::od_1017_0(node).set(500).
namespace clock_objects {

template <class T, std::uint16_t index, std::uint8_t sub>
struct Handle {
  co::Object<T> operator()(CO_NODE& node) const noexcept { return co::object<T>(node, index, sub); }
};

inline constexpr Handle<uint32_t, 0x1000, 0x00> od_1000_0{};
inline constexpr auto& device_type = od_1000_0;
inline constexpr Handle<uint8_t, 0x1001, 0x00> od_1001_0{};
inline constexpr auto& error_register = od_1001_0;
inline constexpr Handle<uint8_t, 0x1003, 0x00> od_1003_0{};
inline constexpr auto& pre_defined_error_field_number_of_errors = od_1003_0;
inline constexpr Handle<uint32_t, 0x1003, 0x01> od_1003_1{};
inline constexpr auto& pre_defined_error_field_standard_error_field_1 = od_1003_1;
inline constexpr Handle<uint32_t, 0x1003, 0x02> od_1003_2{};
inline constexpr auto& pre_defined_error_field_standard_error_field_2 = od_1003_2;
inline constexpr Handle<uint32_t, 0x1003, 0x03> od_1003_3{};
inline constexpr auto& pre_defined_error_field_standard_error_field_3 = od_1003_3;
inline constexpr Handle<uint32_t, 0x1003, 0x04> od_1003_4{};
inline constexpr auto& pre_defined_error_field_standard_error_field_4 = od_1003_4;
inline constexpr Handle<uint32_t, 0x1005, 0x00> od_1005_0{};
inline constexpr auto& cob_id_sync_message = od_1005_0;
inline constexpr Handle<uint32_t, 0x1006, 0x00> od_1006_0{};
inline constexpr auto& communication_cycle_period = od_1006_0;
inline constexpr Handle<uint16_t, 0x100C, 0x00> od_100C_0{};
inline constexpr auto& guard_time = od_100C_0;
inline constexpr Handle<uint8_t, 0x100D, 0x00> od_100D_0{};
inline constexpr auto& life_time_factor = od_100D_0;
inline constexpr Handle<uint8_t, 0x1010, 0x00> od_1010_0{};
inline constexpr auto& store_parameters_highest_sub_index_supported = od_1010_0;
inline constexpr Handle<uint32_t, 0x1010, 0x01> od_1010_1{};
inline constexpr auto& store_parameters_save_all_parameters = od_1010_1;
inline constexpr Handle<uint8_t, 0x1011, 0x00> od_1011_0{};
inline constexpr auto& restore_default_parameters_highest_sub_index_supported = od_1011_0;
inline constexpr Handle<uint32_t, 0x1011, 0x01> od_1011_1{};
inline constexpr auto& restore_default_parameters_restore_all_default_parameters = od_1011_1;
inline constexpr Handle<uint32_t, 0x1014, 0x00> od_1014_0{};
inline constexpr auto& cob_id_emcy = od_1014_0;
inline constexpr Handle<uint16_t, 0x1017, 0x00> od_1017_0{};
inline constexpr auto& producer_heartbeat_time = od_1017_0;
inline constexpr Handle<uint8_t, 0x1018, 0x00> od_1018_0{};
inline constexpr auto& identity_object_highest_sub_index_supported = od_1018_0;
inline constexpr Handle<uint32_t, 0x1018, 0x01> od_1018_1{};
inline constexpr auto& identity_object_vendor_id = od_1018_1;
inline constexpr Handle<uint32_t, 0x1018, 0x02> od_1018_2{};
inline constexpr auto& identity_object_product_code = od_1018_2;
inline constexpr Handle<uint32_t, 0x1018, 0x03> od_1018_3{};
inline constexpr auto& identity_object_revision_number = od_1018_3;
inline constexpr Handle<uint32_t, 0x1018, 0x04> od_1018_4{};
inline constexpr auto& identity_object_serial_number = od_1018_4;
inline constexpr Handle<uint8_t, 0x1020, 0x00> od_1020_0{};
inline constexpr auto& verify_configuration_highest_sub_index_supported = od_1020_0;
inline constexpr Handle<uint32_t, 0x1020, 0x01> od_1020_1{};
inline constexpr auto& verify_configuration_configuration_date = od_1020_1;
inline constexpr Handle<uint32_t, 0x1020, 0x02> od_1020_2{};
inline constexpr auto& verify_configuration_configuration_time = od_1020_2;
inline constexpr Handle<uint8_t, 0x1200, 0x00> od_1200_0{};
inline constexpr auto& sdo_server_parameter_highest_sub_index_supported = od_1200_0;
inline constexpr Handle<uint32_t, 0x1200, 0x01> od_1200_1{};
inline constexpr auto& sdo_server_parameter_cob_id_client_to_server = od_1200_1;
inline constexpr Handle<uint32_t, 0x1200, 0x02> od_1200_2{};
inline constexpr auto& sdo_server_parameter_cob_id_server_to_client = od_1200_2;
inline constexpr Handle<uint8_t, 0x1400, 0x00> od_1400_0{};
inline constexpr auto& rpdo_communication_parameter_highest_sub_index_supported = od_1400_0;
inline constexpr Handle<uint32_t, 0x1400, 0x01> od_1400_1{};
inline constexpr auto& rpdo_communication_parameter_cob_id = od_1400_1;
inline constexpr Handle<uint8_t, 0x1400, 0x02> od_1400_2{};
inline constexpr auto& rpdo_communication_parameter_transmission_type = od_1400_2;
inline constexpr Handle<uint8_t, 0x1600, 0x00> od_1600_0{};
inline constexpr auto& rpdo_mapping_parameter_number_of_mapped_objects = od_1600_0;
inline constexpr Handle<uint32_t, 0x1600, 0x01> od_1600_1{};
inline constexpr auto& rpdo_mapping_parameter_mapped_object_1 = od_1600_1;
inline constexpr Handle<uint32_t, 0x1600, 0x02> od_1600_2{};
inline constexpr auto& rpdo_mapping_parameter_mapped_object_2 = od_1600_2;
inline constexpr Handle<uint32_t, 0x1600, 0x03> od_1600_3{};
inline constexpr auto& rpdo_mapping_parameter_mapped_object_3 = od_1600_3;
inline constexpr Handle<uint8_t, 0x1800, 0x00> od_1800_0{};
inline constexpr auto& tpdo_communication_parameter_highest_sub_index_supported = od_1800_0;
inline constexpr Handle<uint32_t, 0x1800, 0x01> od_1800_1{};
inline constexpr auto& tpdo_communication_parameter_cob_id = od_1800_1;
inline constexpr Handle<uint8_t, 0x1800, 0x02> od_1800_2{};
inline constexpr auto& tpdo_communication_parameter_transmission_type = od_1800_2;
inline constexpr Handle<uint16_t, 0x1800, 0x03> od_1800_3{};
inline constexpr auto& tpdo_communication_parameter_inhibit_time = od_1800_3;
inline constexpr Handle<uint16_t, 0x1800, 0x05> od_1800_5{};
inline constexpr auto& tpdo_communication_parameter_event_timer = od_1800_5;
inline constexpr Handle<uint8_t, 0x1A00, 0x00> od_1A00_0{};
inline constexpr auto& tpdo_mapping_parameter_number_of_mapped_objects = od_1A00_0;
inline constexpr Handle<uint32_t, 0x1A00, 0x01> od_1A00_1{};
inline constexpr auto& tpdo_mapping_parameter_mapped_object_1 = od_1A00_1;
inline constexpr Handle<uint32_t, 0x1A00, 0x02> od_1A00_2{};
inline constexpr auto& tpdo_mapping_parameter_mapped_object_2 = od_1A00_2;
inline constexpr Handle<uint32_t, 0x1A00, 0x03> od_1A00_3{};
inline constexpr auto& tpdo_mapping_parameter_mapped_object_3 = od_1A00_3;
inline constexpr Handle<uint8_t, 0x2100, 0x00> od_2100_0{};
inline constexpr auto& time_highest_sub_index_supported = od_2100_0;
inline constexpr Handle<uint8_t, 0x2100, 0x01> od_2100_1{};
inline constexpr auto& time_hour = od_2100_1;
inline constexpr Handle<uint8_t, 0x2100, 0x02> od_2100_2{};
inline constexpr auto& time_minute = od_2100_2;
inline constexpr Handle<uint8_t, 0x2100, 0x03> od_2100_3{};
inline constexpr auto& time_second = od_2100_3;
inline constexpr Handle<int16_t, 0x2101, 0x00> od_2101_0{};
inline constexpr auto& time_zone = od_2101_0;

}  // namespace clock_objects
#endif

#endif
