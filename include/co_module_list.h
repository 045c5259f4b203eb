// SPDX-License-Identifier: Apache-2.0
/// \file co_module_list.h
/// 1027h, module list: the modules that are connected to a modular device. [CiA 301, 7.5.2.30] Data of each entry: the
/// same CO_MODULE_LIST, which may be constant. Sub-index 0: number of connected modules, UNSIGNED8.
/// Sub-indices 1...254: type of the module in that place, UNSIGNED16. The table has as many sub-indices as the device
/// has places; reading a place without a module is aborted with 0800 0024h. The list cannot be written (0601 0002h).
///
///     static CO_ERR read_module(CO_NODE* node, void* user, uint8_t sub, uint16_t* value);
///     static const CO_MODULE_LIST Modules = {read_module};
///     {CO_KEY(0x1027, 0, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&Modules)},
///     {CO_KEY(0x1027, 1, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&Modules)},
#ifndef CO_MODULE_LIST_H_
#define CO_MODULE_LIST_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Source of the module list, a function of the application.
typedef struct CO_MODULE_LIST_T {
  /// Sets \a value: for \a sub 0 to the number of connected modules, 0...254, otherwise to the type of module \a sub.
  /// \a value is 0 before the call. \a user: CO_NODE_EXT.User. Called when the network or the application reads an
  /// entry. COObjTypeUserSDOAbort() can set the abort code of an error.
  /// \retval CO_ERR_NONE         \a value is set
  /// \retval CO_ERR_OBJ_NO_DATA  there is no module in this place (0800 0024h)
  /// \retval other               the entry cannot be read
  CO_ERR (*Read)(struct CO_NODE_T* node, void* user, uint8_t sub, uint16_t* value);
} CO_MODULE_LIST;

extern const CO_OBJ_TYPE COTModuleList;  ///< functions of CO_TMODULE_LIST

#define CO_TMODULE_LIST ((const CO_OBJ_TYPE*)&COTModuleList)  ///< type of 1027h, all sub-indices

#ifdef __cplusplus
}
#endif

#endif
