// SPDX-License-Identifier: Apache-2.0
// Example of docs/recorder.md: a recorder of a temperature, configured by the device and over the network.
#include <string.h>

#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;
static int16_t Temperature;  // 0.1 degrees Celsius

static CO_RECORDER_POINT Points[256];
static uint8_t Name[24] = "temperature";
static CO_RECORDER Recorder;
static uint8_t Enable = 1;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2110, 0, CO_OBJ____PR_), CO_TSIGNED16, (CO_DATA)(&Temperature)},
    {CO_KEY(0x2301, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(10)},
    {CO_KEY(0x2301, 1, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},  // points in use
    {CO_KEY(0x2301, 2, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},  // axis number
    {CO_KEY(0x2301, 3, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&Recorder.Name)},
    {CO_KEY(0x2301, 4, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // colour
    {CO_KEY(0x2301, 5, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // recorded object
    {CO_KEY(0x2301, 6, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // format of the plot
    {CO_KEY(0x2301, 7, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // trigger
    {CO_KEY(0x2301, 8, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // threshold
    {CO_KEY(0x2301, 9, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},   // points before the trigger
    {CO_KEY(0x2301, 10, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&Recorder)},  // time between two samples
    {CO_KEY(0x2400, 0, CO_OBJ_____RW), CO_TREC_ENABLE, (CO_DATA)(&Enable)},
    {CO_KEY(0x2401, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
    {CO_KEY(0x2401, 1, CO_OBJ_____RW), CO_TREC_DATA, (CO_DATA)(&Recorder)},  // points held
    {CO_KEY(0x2401, 2, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&Recorder)},  // last value
    {CO_KEY(0x2401, 3, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&Recorder)},  // minimum
    {CO_KEY(0x2401, 4, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&Recorder)},  // maximum
    {CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, (CO_DATA)(&Recorder)},  // plot
    {CO_KEY(0x2401, 6, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&Recorder)},  // time of the trigger
};

static void SetUpRecorder(void) {  // before CONodeInit()
  memset(&Recorder, 0, sizeof(Recorder));
  Recorder.Points = Points;
  Recorder.Num = 256;
  Recorder.Name.Start = Name;
  Recorder.Name.Size = 11;
  Recorder.Name.Capacity = sizeof(Name);
  Recorder.Config.Size = 256;                    // points in use
  Recorder.Config.Map = CO_LINK(0x2110, 0, 16);  // index, sub-index and bits, as in a PDO mapping
  Recorder.Config.Period = 10;                   // ms between two samples
  Recorder.Config.Colour = 0xC00000;             // red
  Recorder.Config.Trigger = CO_RECORDER_RISING;  // starts where the temperature reaches ...
  Recorder.Config.Threshold = 800;               // ... 80.0 degrees,
  Recorder.Config.PreTrigger = 64;               // and keeps 64 points from before
}

static void StartNode(void) {
  SetUpRecorder();
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
}

void a_recorder_keeps_the_points_around_its_trigger(void) {
  StartNode();
  for (Temperature = 790; Temperature <= 802; Temperature = (int16_t)(Temperature + 4)) {
    (void)BenchRun(10);
  }
  CO_RECORDER_POINT point;
  TEST_ASSERT_EQUAL_UINT32(4, CORecorderCount(&Recorder));
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, CORecorderGet(&Recorder, 3, &point));
  TEST_ASSERT_EQUAL_INT32(802, point.Value);
  TEST_ASSERT_EQUAL_STRING("585: 43 01 24 06 28 00 00 00", BenchSend("605: 40 01 24 06 00 00 00 00"));
}

void a_client_configures_a_recorder_and_reads_its_plot(void) {
  StartNode();
  // no trigger; the time between two samples is 1 ms
  TEST_ASSERT_EQUAL_STRING("585: 60 01 23 07 00 00 00 00", BenchSend("605: 2F 01 23 07 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 01 23 0A 00 00 00 00", BenchSend("605: 2B 01 23 0A 01 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 01 24 01 00 00 00 00", BenchSend("605: 23 01 24 01 00 00 00 00"));
  Temperature = -5;
  (void)BenchRun(2);
  // length unknown; then the text, of the time and the value of each point
  TEST_ASSERT_EQUAL_STRING("585: 40 01 24 05 00 00 00 00", BenchSend("605: 40 01 24 05 00 00 00 00"));
  const char* text = BenchSend("605: 60 00 00 00 00 00 00 00");
  TEST_ASSERT_EQUAL_INT(0, strncmp(text, "585: 0", 6));
}
