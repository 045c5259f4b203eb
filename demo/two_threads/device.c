// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L

#include "device.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <time.h>

#include "bus.h"
#include "clock.h"
#include "error.h"
#include "memory.h"

#define CYCLE_NANOSECONDS 1000000
#define SYNC_MICROSECONDS 5000u
#define TEMPERATURE_ERROR 0u

// Data shared by the threads. Each pair contains a value and its complement, so that a partial update is detected.
static uint32_t Input[2] = {0, ~0u};
static uint32_t Output[2] = {0, ~0u};
static uint8_t Alarm;
static uint8_t ErrorRegister;
static struct {
  uint32_t Limit;
  uint8_t Profile[PROFILE_SIZE];
} Parameters, Defaults = {100, {0}};
static CO_OBJ_DOM Profile = {0, PROFILE_SIZE, Parameters.Profile};
static CO_PARA Group = OD_GROUP("PARAMETERS", Parameters, Defaults, 0, CO_RESET_NODE, CO_PARA___E);

static CO_OBJ Objects[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                           {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)&ErrorRegister},
                           {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, (CO_DATA)0x40000080},
                           {CO_KEY(0x1006, 0, CO_OBJ_D___R_), CO_TSYNC_CYCLE, (CO_DATA)SYNC_MICROSECONDS},
                           {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)&Group},
                           {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)&Group},
                           {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)0x80},
                           {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                           {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)0x200},
                           {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)1},
                           {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)2},
                           {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20000120},
                           {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20000220},
                           {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)0x40000180},
                           {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)1},
                           {CO_KEY(0x1801, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)0x40000280},
                           {CO_KEY(0x1801, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)255},
                           {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)2},
                           {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20010120},
                           {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20010220},
                           {CO_KEY(0x1A01, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)1},
                           {CO_KEY(0x1A01, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x21020008},
                           {CO_KEY(0x2000, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)&Input[0]},
                           {CO_KEY(0x2000, 2, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)&Input[1]},
                           {CO_KEY(0x2001, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)&Output[0]},
                           {CO_KEY(0x2001, 2, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)&Output[1]},
                           {CO_KEY(0x2100, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)&Parameters.Limit},
                           {CO_KEY(0x2101, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)&Profile},
                           {CO_KEY(0x2102, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)&Alarm},
                           CO_OBJ_DICT_ENDMARK};
#define OBJECTS (sizeof(Objects) / sizeof(Objects[0]))

static CO_NODE Node;
static CO_EMCY_TBL Errors[] = {{CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR}};
static uint8_t SdoBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
static CO_IF_FRM Frames[256];
static CO_RING Ring;
static OD_entry_t List[OD_LIST_N(OBJECTS)];
static OD_t Od;
static pthread_mutex_t Mutex;
static CO_NODE_EXT Ext;
static DEVICE_REPORT Report;
static atomic_bool StopRequested;
static pthread_t RealTimeThread;
static pthread_t MainlineThread;

#ifdef WITHOUT_NODE_LOCK  // no node lock: for the test that the thread sanitizer reports the data races
static void Enter(void* user) { CO_UNUSED(user); }
static void Leave(void* user) { CO_UNUSED(user); }
#else
static void Enter(void* user) { (void)pthread_mutex_lock((pthread_mutex_t*)user); }
static void Leave(void* user) { (void)pthread_mutex_unlock((pthread_mutex_t*)user); }
#endif

// Called in the real-time thread, which holds the node lock.
void DeviceCountPdo(void) { ++Report.Received; }
bool IsDevice(const CO_NODE* node) { return node == &Node; }

// Control task of the device. The SDO server in the other thread accesses the same objects.
static void UpdateOutputs(void) {
  CO_LOCK_OD(&Node);
  Report.MismatchedPairs += Input[1] == ~Input[0] ? 0 : 1;
  Output[0] = Input[0] + 1;
  Output[1] = ~Output[0];
  CO_UNLOCK_OD(&Node);
}

static void AddCycle(struct timespec* time) {
  time->tv_nsec += CYCLE_NANOSECONDS;
  if (time->tv_nsec >= 1000000000) {
    time->tv_nsec -= 1000000000;
    ++time->tv_sec;
  }
}

// Uses a priority above that of all other threads, if the program has the permission.
static void* RealTime(void* unused) {
  const struct sched_param priority = {.sched_priority = 50};
  struct timespec next;
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
  (void)clock_gettime(CLOCK_MONOTONIC, &next);
  while (!atomic_load(&StopRequested)) {
    const uint32_t start = ClockMicroseconds();
    CONodeRealTime(&Node);
    UpdateOutputs();
    const uint32_t duration = ClockMicroseconds() - start;
    Report.LongestCycle = duration > Report.LongestCycle ? duration : Report.LongestCycle;
    ++Report.Cycles;
    AddCycle(&next);
    (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
  }
  return unused;
}

// Raises an error for an alarm that the network has written, and sends it back by an event-driven TPDO.
static void ReportAlarm(void) {
  static uint8_t seen;
  uint8_t alarm = 0;
  OD_entry_t* const entry = OD_find(&Od, 0x2102);
  CO_LOCK_OD(&Node);
  (void)OD_get_u8(entry, 0, &alarm, false);
  CO_UNLOCK_OD(&Node);
  if (alarm == seen) {
    return;
  }
  seen = alarm;
  CO_LOCK_EMCY(&Node);
  if (alarm != 0) {
    COEmcySet(&Node.Emcy, TEMPERATURE_ERROR, NULL);
  } else {
    COEmcyClr(&Node.Emcy, TEMPERATURE_ERROR);
  }
  CO_UNLOCK_EMCY(&Node);
  CO_LOCK_CAN_SEND(&Node);
  OD_requestTPDO(entry, 0);
  CO_UNLOCK_CAN_SEND(&Node);
}

// Polls every millisecond, because frames that the real-time thread has put into the ring do not end its sleep. Frames
// that arrive meanwhile are processed in the next round, so that they do not delay the timers.
static void* Mainline(void* unused) {
  while (!atomic_load(&StopRequested)) {
    for (unsigned calls = CORingCount(&Ring) + 1u; calls != 0; --calls) {
      CONodeProcess(&Node);
    }
    COTmrProcess(&Node.Tmr);
    ReportAlarm();
    ClockWait(1000);
  }
  return unused;
}

// With priority inheritance other threads cannot delay the mainline while the real-time thread waits for it.
static void MakeMutex(void) {
  pthread_mutexattr_t attributes;
  (void)pthread_mutexattr_init(&attributes);
  (void)pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
  (void)pthread_mutex_init(&Mutex, &attributes);
  (void)pthread_mutexattr_destroy(&attributes);
}

static CO_ERR InitNode(void) {
  CO_NODE_SPEC spec = {DEVICE_ID, 1000000, Objects, OBJECTS, Errors, NULL, 0, TICKS_PER_SECOND, NULL, SdoBuffer};
  (void)CORingInit(&Ring, Frames, sizeof(Frames) / sizeof(Frames[0]));
  (void)OD_init(&Od, List, OD_LIST_N(OBJECTS), &Node, Objects, OBJECTS);
  CONodeInitEx(&Node, &spec, &Ext);
  return PrintError(&Node, "the device");
}

CO_ERR DeviceStart(void* controller) {
  MakeMutex();
  Ext.Size = sizeof(Ext);
  Ext.Can = &BusDriver;
  Ext.CanCtx = controller;
  Ext.Timer = &ClockDriver;
  Ext.Nvm = &SlowMemoryDriver;
  Ext.Enter = Enter;
  Ext.Leave = Leave;
  Ext.User = &Mutex;
  Ext.Mainline = &Ring;
  Ext.Od = &Od;
  Ext.EmcyNum = 1;
  const CO_ERR err = InitNode();
  CONodeStart(&Node);
  (void)pthread_create(&RealTimeThread, NULL, RealTime, NULL);
  (void)pthread_create(&MainlineThread, NULL, Mainline, NULL);
  return err;
}

DEVICE_REPORT DeviceStop(void) {
  atomic_store(&StopRequested, true);
  (void)pthread_join(RealTimeThread, NULL);
  (void)pthread_join(MainlineThread, NULL);
  const CO_NODE_COUNTERS counters = CONodeGetCounters(&Node);
  Report.Lost = counters.Dropped + counters.CanEvents[CO_CAN_OVERRUN];
  CONodeStop(&Node);
  return Report;
}

uint32_t DeviceStoredLimit(void) {
  Parameters.Limit = 0;
  (void)InitNode();
  CONodeStop(&Node);
  return Parameters.Limit;
}
