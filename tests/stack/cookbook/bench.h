// SPDX-License-Identifier: Apache-2.0
/// \file bench.h
/// A node on a virtual bus for the recipes of docs/cookbook.md: node-ID 5, 250 kbit/s, a timer of 1 kHz, a memory of 1
/// Kbyte that survives BenchStart(). Frames are text: "605: 40 17 10 00 00 00 00 00", "705: R" for a remote frame.
#ifndef LEXICAN_COOKBOOK_BENCH_H_
#define LEXICAN_COOKBOOK_BENCH_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The node that BenchStart() starts.
extern CO_NODE Node;
/// Specification and drivers of the node. A recipe may change them before it calls BenchStart(), which initialises the
/// node with them. setUp() restores them before each test.
extern CO_NODE_SPEC Spec;
extern CO_NODE_EXT Ext;

/// Powers a node with \a num entries on, and runs it for 1 ms. Returns CONodeGetErr().
CO_ERR BenchStart(const CO_OBJ* dictionary, uint16_t num);

/// Runs the node for \a ms milliseconds. Returns the frames that it sent since the last call, with " | " between them;
/// valid until the next call.
const char* BenchRun(unsigned ms);

/// Sends a frame to the node and runs it for 1 ms. Returns the frames that it sent, like BenchRun().
const char* BenchSend(const char* frame);

#ifdef __cplusplus
}
#endif

#define BENCH_NUM(array) ((uint16_t)(sizeof(array) / sizeof((array)[0])))

#endif
