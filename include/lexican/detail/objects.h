// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/objects.h
/// The objects for which the stack has a type: one row for each type and its indices. From it come the rules of the
/// compiler and of the node (lexican/detail/rules.hpp, lexican/dictionary.hpp) and the types that codict chooses; a
/// test compares it with docs/features.md. Needs no configuration: settings are names.
#ifndef LEXICAN_DETAIL_OBJECTS_H_
#define LEXICAN_DETAIL_OBJECTS_H_

// clang-format off
/// X(rule, type, functions, first index, last index, first sub-index, last sub-index, bytes, flags, value, use, setting)
/// - rule: name in co::rules; type: macro for tables; functions: the CO_OBJ_TYPE
/// - bytes: length of the value, 0: varies
/// - flags: D: a value in Data is allowed; N: flag N is allowed; T: the indices are those of RPDOs, and those of TPDOs,
///   400h higher, are allowed, too; _: none
/// - value: kind of the C++ type, co::dictionary::Value
/// - use: of the entry by codict, see Service in tools/codict/src/gen/forms.hpp
/// - setting: of co_cfg.h, must not be 0
#define CO_OBJECTS(X) \
  X(emcy_history_number,   CO_TEMCY_HIST,       COTEmcyHist,       0x1003, 0x1003, 0, 0,   1, D,   unsigned_integer, value,    USE_EMCY) \
  X(emcy_history,          CO_TEMCY_HIST,       COTEmcyHist,       0x1003, 0x1003, 1, 254, 4, _,   unsigned_integer, fixed,    USE_EMCY) \
  X(sync_cob_id,           CO_TSYNC_ID,         COTSyncId,         0x1005, 0x1005, 0, 0,   4, DN,  unsigned_integer, value,    USE_SYNC) \
  X(sync_period,           CO_TSYNC_CYCLE,      COTSyncCycle,      0x1006, 0x1006, 0, 0,   4, D,   unsigned_integer, value,    USE_SYNC) \
  X(sync_window,           CO_TSYNC_WINDOW,     COTSyncCycle,      0x1007, 0x1007, 0, 0,   4, D,   unsigned_integer, value,    USE_SYNC) \
  X(store_number,          CO_TPARA_STORE,      COTParaStore,      0x1010, 0x1010, 0, 0,   1, D,   unsigned_integer, value,    USE_PARA) \
  X(store,                 CO_TPARA_STORE,      COTParaStore,      0x1010, 0x1010, 1, 127, 4, _,   unsigned_integer, group,    USE_PARA) \
  X(restore_number,        CO_TPARA_RESTORE,    COTParaStore,      0x1011, 0x1011, 0, 0,   1, D,   unsigned_integer, value,    USE_PARA) \
  X(restore,               CO_TPARA_RESTORE,    COTParaStore,      0x1011, 0x1011, 1, 127, 4, _,   unsigned_integer, group,    USE_PARA) \
  X(time_cob_id,           CO_TTIME_ID,         COTTimeId,         0x1012, 0x1012, 0, 0,   4, DN,  unsigned_integer, value,    USE_TIME) \
  X(time_high_res,         CO_TTIME_HIGH_RES,   COTTimeHighRes,    0x1013, 0x1013, 0, 0,   4, _,   unsigned_integer, fixed,    USE_TIME_HIGH_RES) \
  X(emcy_cob_id,           CO_TEMCY_ID,         COTEmcyId,         0x1014, 0x1014, 0, 0,   4, DN,  unsigned_integer, value,    USE_EMCY) \
  X(heartbeat_consumers,   CO_THB_CONS,         COTNmtHbCons,      0x1016, 0x1016, 0, 0,   1, D,   unsigned_integer, value,    CO_HBCONS_N) \
  X(heartbeat_consumer,    CO_THB_CONS,         COTNmtHbCons,      0x1016, 0x1016, 1, 127, 4, _,   unsigned_integer, consumer, CO_HBCONS_N) \
  X(heartbeat_producer,    CO_THB_PROD,         COTNmtHbProd,      0x1017, 0x1017, 0, 0,   2, D,   unsigned_integer, value,    always) \
  X(sync_counter,          CO_TSYNC_COUNT,      COTSyncCount,      0x1019, 0x1019, 0, 0,   1, D,   unsigned_integer, value,    USE_SYNC) \
  X(verify_configuration,  CO_TVERIFY_CONFIG,   COTVerifyConfig,   0x1020, 0x1020, 1, 2,   4, _,   unsigned_integer, fixed,    USE_PARA) \
  X(os_command,            CO_TOS_COMMAND,      COTOsCommand.Type, 0x1023, 0x1025, 1, 1,   0, _,   bytes,            shared,   USE_OBJ_EX) \
  X(os_status,             CO_TOS_STATUS,       COTOsStatus,       0x1023, 0x1025, 2, 2,   1, _,   unsigned_integer, shared,   USE_OBJ_EX) \
  X(os_reply,              CO_TOS_REPLY,        COTOsReply.Type,   0x1023, 0x1025, 3, 3,   0, _,   bytes,            shared,   USE_OBJ_EX) \
  X(os_mode,               CO_TOS_MODE,         COTOsMode,         0x1024, 0x1024, 0, 0,   1, _,   unsigned_integer, shared,   USE_OBJ_EX) \
  X(os_input,              CO_TOS_STDIN,        COTOsStdin,        0x1026, 0x1026, 1, 1,   1, _,   unsigned_integer, shared,   always) \
  X(os_output,             CO_TOS_STDOUT,       COTOsStdout,       0x1026, 0x1026, 2, 3,   1, _,   unsigned_integer, shared,   always) \
  X(module_number,         CO_TMODULE_LIST,     COTModuleList,     0x1027, 0x1027, 0, 0,   1, _,   unsigned_integer, shared,   always) \
  X(module_list,           CO_TMODULE_LIST,     COTModuleList,     0x1027, 0x1027, 0, 254, 2, _,   unsigned_integer, shared,   always) \
  X(emcy_consumer,         CO_TEMCY_CONS,       COTEmcyCons,       0x1028, 0x1028, 1, 127, 4, D,   unsigned_integer, value,    CO_EMCY_CONS_N) \
  X(error_behaviour,       CO_TERROR_BEHAVIOUR, COTErrorBehaviour, 0x1029, 0x1029, 0, 254, 1, D,   unsigned_integer, value,    always) \
  X(sdo_cob_id,            CO_TSDO_ID,          COTSdoId,          0x1200, 0x12FF, 1, 2,   4, DN,  unsigned_integer, value,    always) \
  X(global_fail_safe,      CO_TGFC,             COTGfc,            0x1300, 0x1300, 0, 0,   1, D,   unsigned_integer, value,    USE_GFC) \
  X(srdo_direction,        CO_TSRDO_COM,        COTSrdoCom,        0x1301, 0x1340, 1, 1,   1, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_cycle,            CO_TSRDO_COM,        COTSrdoCom,        0x1301, 0x1340, 2, 2,   2, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_byte,             CO_TSRDO_COM,        COTSrdoCom,        0x1301, 0x1340, 3, 4,   1, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_cob_id,           CO_TSRDO_COM,        COTSrdoCom,        0x1301, 0x1340, 5, 6,   4, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_number,           CO_TSRDO_MAP,        COTSrdoMap,        0x1381, 0x13C0, 0, 0,   1, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_mapping,          CO_TSRDO_MAP,        COTSrdoMap,        0x1381, 0x13C0, 1, 16,  4, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(srdo_valid,            CO_TSRDO_VALID,      COTSrdoValid,      0x13FE, 0x13FE, 0, 0,   1, D,   unsigned_integer, fixed,    CO_SRDO_N) \
  X(srdo_signature,        CO_TSRDO_SIGNATURE,  COTSrdoSignature,  0x13FF, 0x13FF, 1, 64,  2, D,   unsigned_integer, value,    CO_SRDO_N) \
  X(pdo_cob_id,            CO_TPDO_ID,          COTPdoId,          0x1400, 0x15FF, 1, 1,   4, DNT, unsigned_integer, value,    always) \
  X(pdo_type,              CO_TPDO_TYPE,        COTPdoType,        0x1400, 0x15FF, 2, 2,   1, DT,  unsigned_integer, value,    always) \
  X(pdo_inhibit,           CO_TPDO_INHIBIT,     COTPdoInhibit,     0x1400, 0x15FF, 3, 3,   2, DT,  unsigned_integer, value,    always) \
  X(pdo_event,             CO_TPDO_EVENT,       COTPdoEvent,       0x1400, 0x15FF, 5, 5,   2, DT,  unsigned_integer, value,    always) \
  X(pdo_number,            CO_TPDO_NUM,         COTPdoNum,         0x1600, 0x17FF, 0, 0,   1, DT,  unsigned_integer, value,    always) \
  X(pdo_mapping,           CO_TPDO_MAP,         COTPdoMap,         0x1600, 0x17FF, 1, 64,  4, DT,  unsigned_integer, value,    always) \
  X(pdo_start,             CO_TPDO_START,       COTPdoStart,       0x1800, 0x19FF, 6, 6,   1, D,   unsigned_integer, value,    always) \
  X(nmt_startup,           CO_TNMT_STARTUP,     COTNmtStartup,     0x1F80, 0x1F80, 0, 0,   4, D,   unsigned_integer, value,    always) \
  X(pdo_scan,              CO_TPDO_SCAN,        COTPdoScan,        0x1FA0, 0x1FCF, 1, 254, 4, D,   unsigned_integer, value,    CO_MPDO_N) \
  X(pdo_dispatch,          CO_TPDO_DISPATCH,    COTPdoDispatch,    0x1FD0, 0x1FFF, 1, 254, 8, D,   unsigned_integer, value,    CO_MPDO_N) \
  X(recorder_size,         CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 1, 1,   4, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_axis,         CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 2, 2,   1, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_colours,      CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 4, 5,   4, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_modes,        CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 6, 7,   1, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_threshold,    CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 8, 8,   4, _,   integer,          none,     USE_RECORDER) \
  X(recorder_pre_trigger,  CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 9, 9,   4, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_period,       CO_TREC_CONFIG,      COTRecConfig,      0x2000, 0x5FFF, 10, 10, 2, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_data,         CO_TREC_DATA,        COTRecData,        0x2000, 0x5FFF, 1, 4,   4, _,   integer,          none,     USE_RECORDER) \
  X(recorder_trigger_time, CO_TREC_DATA,        COTRecData,        0x2000, 0x5FFF, 6, 6,   4, _,   unsigned_integer, none,     USE_RECORDER) \
  X(recorder_plot,         CO_TREC_PLOT,        COTRecPlot.Type,   0x2000, 0x5FFF, 0, 254, 0, _,   bytes,            none,     USE_RECORDER) \
  X(recorder_enable,       CO_TREC_ENABLE,      COTRecEnable,      0x2000, 0x5FFF, 0, 254, 1, _,   boolean,          none,     USE_RECORDER)
// clang-format on

#endif
