// SPDX-License-Identifier: Apache-2.0
/// \file co_recorder.h
/// Recorder (USE_RECORDER): records the values of an object of the dictionary over time, like an oscilloscope, in
/// memory of the application, and returns them as CSV or as numbers; lexican mon --html draws the CSV. It is specific
/// to this stack; its two records follow the trace objects of CANopenNode. A node can have any number of recorders.
///
/// Configuration record, CO_TREC_CONFIG, usually 2301h…:
/// | sub | type | content |
/// |---|---|---|
/// | 1 | UNSIGNED32 | points in use, up to CO_RECORDER.Num; 0: no points are recorded |
/// | 2 | UNSIGNED8 | axis number, for the tool that draws; not used by the stack |
/// | 3 | VISIBLE_STRING | name, for the tool that draws (CO_TVISIBLE_STRING, Data: &Recorder.Name) |
/// | 4 | UNSIGNED32 | colour of the curve, RRGGBBh, for the tool that draws |
/// | 5 | UNSIGNED32 | recorded object: index, sub-index and bits (8, 16, 24, 32) as in a PDO mapping; 0: none |
/// | 6 | UNSIGNED8 | format of the plot: CO_RECORDER_CSV or _BINARY, plus CO_RECORDER_UNSIGNED |
/// | 7 | UNSIGNED8 | trigger: CO_RECORDER_FREE, _RISING, _FALLING or _BOTH |
/// | 8 | INTEGER32 | threshold of the trigger |
/// | 9 | UNSIGNED32 | points to be kept from before the trigger: 0, or less than sub-index 1 |
/// | 10 | UNSIGNED16 | time between two samples in ms; 0: CORecorderSample() only |
///
/// Data record, usually 2401h…: CO_TREC_DATA, and CO_TREC_PLOT for sub-index 5.
/// | sub | type | content |
/// |---|---|---|
/// | 1 | UNSIGNED32 | points held; writing 0 empties the recorder and starts it again |
/// | 2 | INTEGER32 | last value |
/// | 3, 4 | INTEGER32 | minimum, maximum since the recorder was started |
/// | 5 | DOMAIN | the plot, generated while it is read |
/// | 6 | UNSIGNED32 | time of the last trigger in ms; 0: none |
///
/// CO_TREC_ENABLE, usually 2400h, BOOLEAN: while it is 0, no recorder of the node takes samples; 1 continues them.
///
///     static CO_RECORDER_POINT Points[256];
///     static uint8_t Name[] = "temperature";
///     static CO_RECORDER Recorder;
///     …
///     Recorder.Points = Points;   // before CONodeInit()
///     Recorder.Num = 256;
///     Recorder.Name.Start = Name;
///     Recorder.Name.Size = sizeof(Name) - 1;
///     Recorder.Config.Size = 256;
///     Recorder.Config.Map = CO_LINK(0x2110, 0, 16);
///     Recorder.Config.Period = 10;
///     …
///     {CO_KEY(0x2301, 1, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},
///     {CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, (CO_DATA)(&Recorder)},
///
/// **Recording.** The object is read at each sample, in every NMT state, and a point is added if its value has changed.
/// Numbers of 8 to 32 bits are recorded: as signed numbers, unless CO_RECORDER_UNSIGNED is set. The bits of a REAL32
/// are recorded as a number. Without a trigger, a new point overwrites the oldest one. With a trigger, only the most
/// recent points (their number is sub-index 9) are kept until the value crosses the threshold (a value that equals the
/// threshold is above it); then points are added until the memory is full. The time of a point is in milliseconds since
/// the first recorder of the node was started, modulo 2^32.
///
/// **Plot.** An upload, segmented or by block, returns the points that are held when it begins. Recording continues
/// meanwhile: points that are overwritten before they are sent are left out. A complete upload removes the points that
/// it began with; a recorder that has stopped because its memory is full then waits for its trigger again. An aborted
/// upload removes none. A block upload is aborted (0800 0022h) if it has to repeat points that are overwritten. One
/// client at a time can read the plot.
/// - CSV: a line `time;value` for each point, ended by a line feed.
/// - Binary: for each point the time, UNSIGNED32, and the value, INTEGER32, both little-endian.
///
/// **Configuration.** Each write is checked against the whole configuration: a recorded object that does not exist is
/// refused with 0602 0000h, one that cannot be read or is not a number of this length with 0604 0041h, any other wrong
/// value with 0609 0030h. A change of sub-index 1, 5, 7, 8, 9 or of CO_RECORDER_UNSIGNED empties the recorder and
/// starts it again, and so do CONodeInit() and NMT resets. While the plot is being read, changes are refused (0800
/// 0022h).
///
/// CO_RECORDER.Config may be a parameter group (co_para.h). The access hook (CO_CALLBACKS) is called for the objects of
/// the recorder, not for the recorded object: refuse writes to sub-index 5 if clients may not read every object.
///
/// Context: the loop; with USE_REAL_TIME also other threads that hold the node lock.
#ifndef CO_RECORDER_H_
#define CO_RECORDER_H_

#include "co_err.h"
#include "co_obj.h"
#include "co_string.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// \name Format of the plot
/// \{
enum {
  CO_RECORDER_CSV = 0,     ///< text, a line for each point
  CO_RECORDER_BINARY = 1,  ///< 8 bytes for each point
  /// Gone: refused with 0609 0030h (CO_ERR_OBJ_RANGE). Read the plot as CSV and draw it: lexican mon --html.
  CO_RECORDER_SVG = 2,
  CO_RECORDER_UNSIGNED = 0x10,  ///< added to one of these: the object is unsigned
};
/// \}

/// \name Trigger
/// \{
enum {
  CO_RECORDER_FREE = 0,     ///< no trigger: the last points are held
  CO_RECORDER_RISING = 1,   ///< the value reaches the threshold from below
  CO_RECORDER_FALLING = 2,  ///< the value falls below the threshold
  CO_RECORDER_BOTH = 3,     ///< either
};
/// \}

/// A recorded point.
typedef struct CO_RECORDER_POINT_T {
  uint32_t Time;  ///< ms
  int32_t Value;  ///< value of the object; to be converted to uint32_t with CO_RECORDER_UNSIGNED
} CO_RECORDER_POINT;

/// Configuration of a recorder, in the order of sub-indices where alignment allows it. Set by the application before
/// CONodeInit(), later by CORecorderConfigure() or the network.
typedef struct CO_RECORDER_CONFIG_T {
  uint32_t Size;        ///< points in use: 0…CO_RECORDER.Num
  uint32_t Colour;      ///< colour of the curve: RRGGBBh, for tools
  uint32_t Map;         ///< recorded object: CO_LINK(index, sub-index, bits), or 0
  int32_t Threshold;    ///< threshold of the trigger
  uint32_t PreTrigger;  ///< points to be kept from before the trigger
  uint16_t Period;      ///< ms between two samples; 0: CORecorderSample() only
  uint8_t Axis;         ///< axis number, for tools
  uint8_t Format;       ///< CO_RECORDER_CSV or _BINARY, plus CO_RECORDER_UNSIGNED
  uint8_t Trigger;      ///< CO_RECORDER_FREE, _RISING, _FALLING or _BOTH
} CO_RECORDER_CONFIG;

/// \cond internal
/// Plot that is being read.
typedef struct CO_RECORDER_PLOT_T {
  CO_RECORDER_POINT Point;  ///< copy of the point at Position
  uint32_t Position;        ///< bytes of the plot before the next point
  uint32_t At;              ///< position of the next read
  uint32_t Left;            ///< points from the next one to the last one of the plot
  uint32_t New;             ///< the last points of the plot, which were not read yet, also not before a repetition
  uint32_t Since;           ///< points recorded since the upload began, at most the points in use
  uint32_t Key;             ///< entry that is being read
  uint8_t Reading;          ///< 1: an upload is open
} CO_RECORDER_PLOT;
/// \endcond

/// A recorder, in RAM. The application sets the members up to Config before CONodeInit(); the others must be 0 at
/// first and must not be accessed. Owner: the application; it must outlive the node, and only one node may use it.
typedef struct CO_RECORDER_T {
  CO_RECORDER_POINT* Points;   ///< memory of the points; may be null if Num is 0
  uint32_t Num;                ///< points at Points
  CO_OBJ_STR_RW Name;          ///< for tools; Start may be null
  CO_RECORDER_CONFIG Config;   ///< configuration
  struct CO_NODE_T* Node;      ///< owner
  struct CO_RECORDER_T* Next;  ///< next recorder of the node
  CO_TMR_MEM Tmr;              ///< time until the next sample
  uint32_t Limit;              ///< points in use
  uint32_t Write;              ///< index of the next point
  uint32_t Held;               ///< number of points
  uint32_t Missing;            ///< points until the recorder is full, after the trigger
  int32_t Value;               ///< last value
  int32_t Min;                 ///< least value
  int32_t Max;                 ///< greatest value
  uint32_t TriggerTime;        ///< time of the last trigger
  uint8_t State;               ///< idle, waiting for the trigger, triggered, recording, or full
  uint8_t HasValue;            ///< 1: a sample was taken
  CO_RECORDER_PLOT Plot;       ///< plot that is being read
} CO_RECORDER;

/// Recorders of a node. The application must not access the members.
typedef struct CO_RECORDERS_T {
  CO_RECORDER* First;     ///< list of the recorders, linked by CO_RECORDER.Next
  const uint8_t* Enable;  ///< variable of CO_TREC_ENABLE, or null
  uint32_t Tick;          ///< timer clock up to which Time counts
  uint32_t Rest;          ///< part of a millisecond, in units of 1 ms / ticks per second
  uint32_t Time;          ///< ms
} CO_RECORDERS;

extern const CO_OBJ_TYPE COTRecConfig CO_NEEDS(USE_RECORDER);   ///< functions of CO_TREC_CONFIG
extern const CO_OBJ_TYPE COTRecData CO_NEEDS(USE_RECORDER);     ///< functions of CO_TREC_DATA
extern const CO_OBJ_TYPE_EX COTRecPlot CO_NEEDS(USE_RECORDER);  ///< functions of CO_TREC_PLOT
extern const CO_OBJ_TYPE COTRecEnable CO_NEEDS(USE_RECORDER);   ///< functions of CO_TREC_ENABLE

/// Type of sub-indices 1, 2, 4 to 10 of the configuration record, 2000h to 5FFFh; Data: a CO_RECORDER.
#define CO_TREC_CONFIG ((const CO_OBJ_TYPE*)&COTRecConfig)
/// Type of sub-indices 1 to 4 and 6 of the data record, 2000h to 5FFFh; Data: a CO_RECORDER.
#define CO_TREC_DATA ((const CO_OBJ_TYPE*)&COTRecData)
/// Type of sub-index 5 of the data record, 2000h to 5FFFh; Data: a CO_RECORDER. A recorder has one such entry at most.
#define CO_TREC_PLOT ((const CO_OBJ_TYPE*)&COTRecPlot.Type)
/// Type of the object that enables all recorders, 2000h to 5FFFh; Data: a uint8_t.
#define CO_TREC_ENABLE ((const CO_OBJ_TYPE*)&COTRecEnable)

/// Starts a recorder: empties it and begins to sample. CONodeInit() and NMT resets start recorders with entries in the
/// dictionary; the application has to start a recorder without entries after each CONodeInit().
/// \retval CO_ERR_NONE           the recorder is started
/// \retval CO_ERR_BAD_ARG        an argument is null, or the node was never initialised or is stopped
/// \retval CO_ERR_OBJ_NOT_FOUND  the dictionary has no such object
/// \retval CO_ERR_OBJ_MAP_TYPE   the object cannot be read, or is not a number of that length
/// \retval CO_ERR_OBJ_RANGE      another member of the configuration is wrong
/// \retval CO_ERR_OBJ_STATE      the plot is being read
CO_ERR CORecorderStart(struct CO_NODE_T* node, CO_RECORDER* recorder) CO_NEEDS(USE_RECORDER);

/// Replaces the configuration of a recorder that was started. After an error the configuration is unchanged. Returns
/// the errors of CORecorderStart(), or:
/// \retval CO_ERR_BAD_ARG  an argument is null, the recorder was never started, or the node is stopped
CO_ERR CORecorderConfigure(CO_RECORDER* recorder, const CO_RECORDER_CONFIG* config) CO_NEEDS(USE_RECORDER);

/// Takes a sample, in addition to those of the timer: for example when a SYNC was received, or in the cycle of a
/// controller.
/// \retval CO_ERR_NONE          the object was read
/// \retval CO_ERR_BAD_ARG       \a recorder is null, or was never started
/// \retval CO_ERR_OBJ_STATE     the recorders are disabled (CO_TREC_ENABLE), no object is configured, the
///                              configuration in the dictionary was wrong, or the node is stopped
/// \retval CO_ERR_OBJ_NOT_FOUND the object is no longer in the dictionary
/// \retval CO_ERR_OBJ_MAP_TYPE  CODictInit() has changed the object's type, which cannot be recorded
/// \retval other                error of the type of the object
CO_ERR CORecorderSample(CO_RECORDER* recorder) CO_NEEDS(USE_RECORDER);

/// Empties a recorder and starts it again.
/// \retval CO_ERR_NONE       the recorder is empty
/// \retval CO_ERR_BAD_ARG    \a recorder is null, or was never started
/// \retval CO_ERR_OBJ_STATE  the plot is being read
CO_ERR CORecorderClear(CO_RECORDER* recorder) CO_NEEDS(USE_RECORDER);

/// Returns the number of points that a recorder holds; 0 if \a recorder is null.
uint32_t CORecorderCount(const CO_RECORDER* recorder) CO_NEEDS(USE_RECORDER);

/// Copies a point. \a number: 0 is the oldest one.
/// \retval CO_ERR_NONE         \a point is set
/// \retval CO_ERR_BAD_ARG      an argument is null
/// \retval CO_ERR_OBJ_NO_DATA  the recorder does not hold so many points
CO_ERR CORecorderGet(const CO_RECORDER* recorder, uint32_t number, CO_RECORDER_POINT* point) CO_NEEDS(USE_RECORDER);

#ifdef __cplusplus
}
#endif

#endif
