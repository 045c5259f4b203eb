/* SPDX-License-Identifier: Apache-2.0 */
/* Variables as large as the memory of each module (their names begin with "module_"), or else of what a node consists
   of: with one more of something, everything together grows by what that costs. */
#include "co_core.h"

#define SIZE_OF(member) sizeof(((CO_NODE*)0)->member)

#ifdef MODULES

#if USE_CSDO
uint8_t module_sdo_client[SIZE_OF(CSdo)];
#define SDO_CLIENT sizeof module_sdo_client
#else
#define SDO_CLIENT 0
#endif

#if USE_EMCY
uint8_t module_emcy[SIZE_OF(Emcy)];
#define EMCY sizeof module_emcy
#else
#define EMCY 0
#endif

#if CO_MPDO_N > 0
#define MPDO SIZE_OF(Mpdo)
#else
#define MPDO 0
#endif
uint8_t module_pdo[SIZE_OF(RPdo) + SIZE_OF(TPdo) + SIZE_OF(PdoSets) + MPDO];

#if USE_SYNC
uint8_t module_sync[SIZE_OF(Sync)];
#define SYNC sizeof module_sync
#else
#define SYNC 0
#endif

#if USE_TIME
uint8_t module_time[SIZE_OF(Time)];
#define TIME sizeof module_time
#else
#define TIME 0
#endif

#if USE_LED
uint8_t module_led[SIZE_OF(Led)];
#define LED sizeof module_led
#else
#define LED 0
#endif

#if USE_LSS && USE_LSS_MASTER
uint8_t module_lss[SIZE_OF(Lss) + SIZE_OF(Lssm)];
#define LSS sizeof module_lss
#elif USE_LSS
uint8_t module_lss[SIZE_OF(Lss)];
#define LSS sizeof module_lss
#else
#define LSS 0
#endif

#if CO_SRDO_N > 0
uint8_t module_srdo[SIZE_OF(Srdo)];
#define SRDO sizeof module_srdo
#else
#define SRDO 0
#endif

#if USE_RECORDER
uint8_t module_recorder[SIZE_OF(Recorders)];
#define RECORDER sizeof module_recorder
#else
#define RECORDER 0
#endif

#if USE_PARA
uint8_t module_storage[SIZE_OF(Storage)];
#define PARA sizeof module_storage
#else
#define PARA 0
#endif

#if USE_GUARDING
uint8_t module_guarding[SIZE_OF(Guarding)];
#define GUARDING sizeof module_guarding
#else
#define GUARDING 0
#endif

#if CO_HBCONS_N > 0
uint8_t module_heartbeat[SIZE_OF(HbProdTmr) + SIZE_OF(HbConsTmr) + SIZE_OF(HbCons)];
#else
uint8_t module_heartbeat[SIZE_OF(HbProdTmr)];
#endif
#define HEARTBEAT sizeof module_heartbeat

uint8_t module_nmt[SIZE_OF(Nmt)];
uint8_t module_sdo_server[SIZE_OF(Sdo) + SIZE_OF(SdoTmr)];

/* All that is nobody's. */
uint8_t module_base[sizeof(CO_NODE) - sizeof module_nmt - sizeof module_sdo_server - sizeof module_pdo - SDO_CLIENT -
                    EMCY - SYNC - TIME - LED - LSS - SRDO - RECORDER - PARA - GUARDING - HEARTBEAT];

#else

#ifndef ENTRIES
#define ENTRIES 1
#endif
#ifndef VALUES
#define VALUES 1
#endif
#ifndef TIMERS
#define TIMERS 1
#endif

CO_NODE Node;
CO_TMR_MEM Timers[TIMERS];
#ifndef WITHOUT_BUFFER
uint8_t SdoBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
#endif
uint32_t Values[VALUES];
#ifdef OBJECTS
OD_entry_t Index[OBJECTS];
#endif
#ifdef ERROR_BITS
CO_EMCY_BITS ErrorBits[ERROR_BITS];
#endif
#ifdef CONSTANT_DOMAINS
CO_OBJ_DOM_RO ConstantDomains[CONSTANT_DOMAINS];
#endif
#ifdef COMMANDS
CO_OS_COMMAND Commands[COMMANDS];
#endif
#ifdef PROMPTS
CO_OS_PROMPT Prompts[PROMPTS];
#endif
const CO_OBJ Dictionary[ENTRIES] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0}};

#ifdef MAIN
int main(void) {
  CONodeInit(&Node, 0);
  return 0;
}
#endif

#endif
