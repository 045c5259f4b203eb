// SPDX-License-Identifier: Apache-2.0
/// \file co_real_time.h
/// Several threads that use one node (USE_REAL_TIME): the node lock, and the thread of SYNC and PDOs.
///
/// Node lock: CO_NODE_EXT.Enter and Leave, a mutex, or functions that disable an interrupt and enable it. The node
/// works only while the lock is held, so any thread may use it. It is locked by
///   - the stack, in CONodeProcess(), CONodeRealTime(), COTmrProcess() (for each action) and CONodeNextDeadline();
///   - the application, around every other call and every access to memory that the node may use: CO_LOCK_OD(),
///     CO_LOCK_CAN_SEND() and CO_LOCK_EMCY() of co_od.h are three names of it.
/// Callbacks, timer actions, type functions and driver functions run with the lock held. They must neither lock it
/// again nor call one of those four functions: calls do not nest. A program with a single thread does not need the
/// lock. A driver must not block, because other threads wait for the lock. While a memory driver that has a Shape
/// function reads, writes or erases, the stack releases the lock; therefore only one thread may store, load or reset.
///
/// Real-time thread: CO_NODE_EXT.Mainline is the ring of the frames that CONodeRealTime() does not process itself and
/// hands over to CONodeProcess(). Prepared by CORingInit(); the application must not access it afterwards.
/// CO_NODE_EXT.Foreign: whether CONodeRealTime() also puts unrelated frames (no consumer in this node) into the ring,
/// for applications that receive them (CO_CALLBACKS.CanReceive). False: such frames are counted
/// (CO_NODE_COUNTERS.Unclaimed) and discarded.
#ifndef CO_REAL_TIME_H_
#define CO_REAL_TIME_H_

#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// Runs the real-time part of the node; to be called at a fixed rate by a real-time thread where CO_NODE_EXT.Mainline
/// is given. It calls COTmrService(), reads all frames that the driver has, processes those of SYNC and PDOs, puts the
/// others into the ring Mainline for CONodeProcess(), and runs the timers of SYNC and PDOs. The driver's Read function
/// must not block. The function holds the node lock throughout. It waits for the lock at most while another thread
/// processes a frame, runs a timer action, or holds the lock in the application. After CONodeStop() the timers of the
/// application still run, and each call discards one frame, as in CONodeProcess().
///
/// The other thread, the mainline, calls CONodeProcess() and COTmrProcess(), which run all other timers. The order of
/// frames is kept among the frames of either thread. Resets (CONmtReset()) are executed by the mainline: a reset
/// requested in any thread is deferred to the next CONodeProcess(). The report of frames that were lost because the
/// ring was full is deferred likewise: one CO_CAN_OVERRUN, with EMCY 8110h and CONodeCanChange(), for all frames lost
/// since the last report (CORingLost() counts them).
///
/// Callbacks run in the thread in which their event occurs. This function calls COPdoReceive(), COPdoUpdate(),
/// COPdoSyncUpdate(), and COPdoTransmit() of PDOs that a SYNC, a timer or a remote request triggers. COPdoTransmit()
/// also runs in the mainline, or in the thread in which the application triggers a PDO: by COTPdoRequest() and similar
/// functions, by an object with flag A, or by a change of the NMT state. PDOs that share their identifier with another
/// service are processed by the mainline only. Read and Write functions of mapped types, COLedChange(), and callbacks
/// that are caused by another callback (for example CONmtModeChange() by CONmtSetMode()) run in either thread. All
/// other callbacks run in the mainline.
void CONodeRealTime(struct CO_NODE_T* node) CO_NEEDS(USE_REAL_TIME);

#ifdef __cplusplus
}
#endif

#endif
