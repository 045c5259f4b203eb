// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "driver_check.h"

// One controller on the bus, with its driver: a classic driver or one with a context argument.
typedef struct END_T {
  CO_DRIVER_CHECK* Check;
  const CO_IF_CAN_DRV* Plain;
  const CO_IF_CAN_DRV_EX* Ex;
  void* Ctx;
} END;

// A direction in which frames are transferred.
typedef struct WAY_T {
  const END* From;
  const END* To;
  uint32_t Echo;  // bit that the PC sets in the identifier of its answer
} WAY;

// Controllers of a check, and the directions that can be checked.
typedef struct BUS_T {
  END Own;
  END Peer;
  WAY Way[2];
  uint8_t Ways;  // 0: no frame can be received
} BUS;

// Identifier of the frame that requests frames from the PC; these have the next identifier.
#define FEED_REQUEST 0x7F0u

// Identifiers with one, no, or all bits set; even ones, as the PC answers with the next odd one.
static const uint16_t BaseIds[] = {0x000, 0x002, 0x004, 0x008, 0x010, 0x020, 0x040, 0x080, 0x100, 0x200, 0x400, 0x7FE};
#define BASE_IDS (sizeof(BaseIds) / sizeof(BaseIds[0]))

// Calls of the driver of either kind.

static int16_t Checked(const END* end, int16_t result) {
  end->Check->OddResult = end->Check->OddResult || (result > 0 && result != (int16_t)sizeof(CO_IF_FRM));
  return result;
}

static void Init(const END* end) { end->Ex != NULL ? end->Ex->Init(end->Ctx) : end->Plain->Init(); }

static void Enable(const END* end) {
  const uint32_t baud = end->Check->Baudrate == 0 ? 125000u : end->Check->Baudrate;
  end->Ex != NULL ? end->Ex->Enable(end->Ctx, baud) : end->Plain->Enable(baud);
}

static void Reset(const END* end) { end->Ex != NULL ? end->Ex->Reset(end->Ctx) : end->Plain->Reset(); }

static void Close(const END* end) { end->Ex != NULL ? end->Ex->Close(end->Ctx) : end->Plain->Close(); }

static int16_t Read(const END* end, CO_IF_FRM* frm) {
  return Checked(end, end->Ex != NULL ? end->Ex->Read(end->Ctx, frm) : end->Plain->Read(frm));
}

static int16_t Send(const END* end, const CO_IF_FRM* frm) {
  CO_IF_FRM copy = *frm;
  return Checked(end, end->Ex != NULL ? end->Ex->Send(end->Ctx, &copy) : end->Plain->Send(&copy));
}

static void Fill(CO_IF_FRM* frm, uint32_t identifier, uint8_t dlc, uint8_t first) {
  memset(frm, 0, sizeof(*frm));
  frm->Identifier = identifier;
  frm->DLC = dlc;
  for (uint8_t n = 0; n < dlc; ++n) {
    frm->Data[n] = (uint8_t)(first + 0x1D * n);
  }
}

// Reads a frame; error frames are ignored.
static bool ReadFrame(const END* end, CO_IF_FRM* frm) {
  return Read(end, frm) > 0 && (frm->Identifier & CO_IF_FRM_ERROR) == 0;
}

static bool Await(const END* end, CO_IF_FRM* frm) {
  for (uint32_t turn = CheckPatience(end->Check); turn != 0; --turn) {
    if (ReadFrame(end, frm)) {
      return true;
    }
    CheckIdle(end->Check);
  }
  return false;
}

static bool IsQuiet(const END* end) {
  CO_IF_FRM frm;
  for (uint32_t turn = CheckQuiet(end->Check); turn != 0; --turn) {
    if (ReadFrame(end, &frm)) {
      return false;
    }
    CheckIdle(end->Check);
  }
  return true;
}

static bool Offer(const END* end, const CO_IF_FRM* frm) {
  for (uint32_t turn = CheckPatience(end->Check); turn != 0; --turn) {
    if (Send(end, frm) > 0) {
      return true;
    }
    CheckIdle(end->Check);
  }
  return false;
}

static bool IsSame(const WAY* way, const CO_IF_FRM* sent, const CO_IF_FRM* got) {
  const bool remote = (sent->Identifier & CO_IF_FRM_RTR) != 0;
  return got->Identifier == (sent->Identifier | way->Echo) && got->DLC == sent->DLC &&
         (remote || memcmp(got->Data, sent->Data, sent->DLC) == 0);
}

// Sends one frame and receives it. Returns the fault, or null.
static const char* Pass(const WAY* way, const CO_IF_FRM* frm) {
  CO_IF_FRM got;
  if (!Offer(way->From, frm)) {
    return "Send never accepts frame $ with # bytes";
  }
  if (!Await(way->To, &got)) {
    return "frame $ with # bytes is not received";
  }
  return IsSame(way, frm, &got) ? NULL : "frame $ with # bytes is received with other contents";
}

// Transfers a frame in all directions; prints the verdict if it is negative.
static bool PassAll(const BUS* bus, const char* name, const CO_IF_FRM* frm) {
  for (uint8_t way = 0; way < bus->Ways; ++way) {
    const char* const wrong = Pass(&bus->Way[way], frm);
    if (wrong != NULL) {
      CheckSay(bus->Own.Check, CHECK_FAILED, name, wrong, frm->Identifier, frm->DLC);
      return false;
    }
  }
  return true;
}

static void CheckLengths(const BUS* bus) {
  CO_IF_FRM frm;
  for (uint8_t dlc = 0; dlc <= 8; ++dlc) {
    Fill(&frm, 0x122, dlc, 0xA5);
    if (!PassAll(bus, "can.dlc", &frm)) {
      return;
    }
  }
  CheckPass(bus->Own.Check, "can.dlc", "data lengths 0 to 8 are received");
}

// Transfers frames in which each bit of the data is 0 and 1.
static void CheckData(const BUS* bus) {
  CO_IF_FRM frm;
  for (uint8_t bit = 0; bit < 64; ++bit) {
    Fill(&frm, 0x100, 8, 0);
    memset(frm.Data, (bit & 1) != 0 ? 0xFF : 0x00, sizeof(frm.Data));
    frm.Data[bit / 8] ^= (uint8_t)(1u << (bit % 8));
    if (!PassAll(bus, "can.data", &frm)) {
      return;
    }
  }
  CheckPass(bus->Own.Check, "can.data", "each bit of 8 bytes is received at its position");
}

static void CheckBaseIds(const BUS* bus) {
  CO_IF_FRM frm;
  for (size_t n = 0; n < BASE_IDS; ++n) {
    Fill(&frm, BaseIds[n], 2, (uint8_t)n);
    if (!PassAll(bus, "can.id11", &frm)) {
      return;
    }
  }
  CheckPass(bus->Own.Check, "can.id11", "each bit of 11-bit identifiers is received");
}

static void CheckExtendedIds(const BUS* bus) {
  CO_IF_FRM frm;
  if ((bus->Own.Check->Frames & CO_CHECK_29_BIT) == 0) {
    CheckSkip(bus->Own.Check, "can.id29", "the settings exclude 29-bit identifiers");
    return;
  }
  for (uint32_t bit = 0; bit <= 29; ++bit) {
    const uint32_t id = bit == 29 ? 0x1FFFFFFEu : (bit == 0 ? 0 : (uint32_t)1 << bit);
    Fill(&frm, id | CO_IF_FRM_EXT, 3, (uint8_t)bit);
    if (!PassAll(bus, "can.id29", &frm)) {
      return;
    }
  }
  CheckPass(bus->Own.Check, "can.id29", "each bit of 29-bit identifiers is received, with CO_IF_FRM_EXT");
}

static void CheckRemote(const BUS* bus) {
  CO_IF_FRM frm;
  if ((bus->Own.Check->Frames & CO_CHECK_REMOTE) == 0) {
    CheckSkip(bus->Own.Check, "can.remote", "the settings exclude remote frames");
    return;
  }
  Fill(&frm, 0x702 | CO_IF_FRM_RTR, 0, 0);
  if (!PassAll(bus, "can.remote", &frm)) {
    return;
  }
  Fill(&frm, 0x702, 0, 0);
  if (PassAll(bus, "can.remote", &frm)) {
    CheckPass(bus->Own.Check, "can.remote", "remote frames are received with CO_IF_FRM_RTR, data frames without it");
  }
}

// Streams of frames.

typedef struct STREAM_T {
  uint32_t Num;
  uint32_t Window;  // greatest number of frames that are sent and not yet received
  bool Together;    // frames are received only after a whole window was sent
  bool Descending;  // the identifiers descend within a window: each frame has a higher priority than the one before
} STREAM;

static void FillNumbered(CO_IF_FRM* frm, const STREAM* stream, uint32_t number) {
  const uint32_t step = stream->Descending ? 2 * (number % stream->Window) : 0;
  Fill(frm, 0x600 - step, 8, (uint8_t)number);
}

static uint32_t SendSome(const WAY* way, const STREAM* stream, uint32_t sent, uint32_t read) {
  CO_IF_FRM frm;
  while (sent < stream->Num && sent - read < stream->Window) {
    FillNumbered(&frm, stream, sent);
    if (Send(way->From, &frm) <= 0) {
      ++way->From->Check->Refused;
      break;
    }
    ++sent;
  }
  return sent;
}

static bool MayRead(const STREAM* stream, uint32_t sent, uint32_t read) {
  const uint32_t until = read - read % stream->Window + stream->Window;
  return !stream->Together || sent >= until || sent == stream->Num;
}

// Transfers a stream. Returns the fault, or null; number is the number of the faulty frame.
static const char* Stream(const WAY* way, const STREAM* stream, uint32_t* number) {
  CO_DRIVER_CHECK* const c = way->From->Check;
  CO_IF_FRM want;
  CO_IF_FRM got;
  uint32_t sent = 0;
  uint32_t turns = CheckPatience(c);
  *number = 0;
  while (*number < stream->Num && turns != 0) {
    sent = SendSome(way, stream, sent, *number);
    if (!MayRead(stream, sent, *number) || !ReadFrame(way->To, &got)) {
      CheckIdle(c);
      --turns;
      continue;
    }
    turns = CheckPatience(c);
    FillNumbered(&want, stream, *number);
    if (!IsSame(way, &want, &got)) {
      return "frame # of # is received out of order";
    }
    ++*number;
  }
  if (*number < stream->Num) {
    return *number < sent ? "frame # of # was accepted, but not received" : "Send never accepts frame # of #";
  }
  return IsQuiet(way->To) ? NULL : "more frames than # of # are received";
}

static void CheckStream(const BUS* bus, const char* name, const STREAM* stream, const char* good) {
  uint32_t number = 0;
  bus->Own.Check->Refused = 0;
  for (uint8_t way = 0; way < bus->Ways; ++way) {
    const char* const wrong = Stream(&bus->Way[way], stream, &number);
    if (wrong != NULL) {
      CheckSay(bus->Own.Check, CHECK_FAILED, name, wrong, number, stream->Num);
      Reset(&bus->Own);
      return;
    }
  }
  CheckSay(bus->Own.Check, CHECK_OK, name, good, stream->Num, bus->Own.Check->Refused);
}

static uint32_t Burst(const CO_DRIVER_CHECK* c) { return c->Burst == 0 ? 16 : c->Burst; }

static void CheckOrder(const BUS* bus) {
  const uint32_t window = Burst(bus->Own.Check) < 8 ? Burst(bus->Own.Check) : 8;
  const STREAM stream = {8 * window, window, true, true};
  CheckStream(bus, "can.order", &stream, "# frames with rising priority are received in the order of Send");
}

// Sends more frames than the controller can hold, so that Send must refuse some.
static void CheckBusy(const BUS* bus) {
  const STREAM stream = {8 * Burst(bus->Own.Check), Burst(bus->Own.Check), false, false};
  CheckStream(bus, "can.busy", &stream,
              "# frames, refused # times: accepted frames are received once, refused ones never");
}

// Checks that received frames are queued until they are read. The PC sends numbered frames as fast as it can; their
// first byte is the number.
static void CheckFedBurst(const BUS* bus) {
  CO_DRIVER_CHECK* const c = bus->Own.Check;
  CO_IF_FRM frm;
  uint8_t first = 0;
  Fill(&frm, FEED_REQUEST, 1, (uint8_t)Burst(c));
  (void)Offer(&bus->Own, &frm);
  for (uint32_t turn = CheckQuiet(c); turn != 0; --turn) {  // all frames arrive before the first one is read
    CheckIdle(c);
  }
  for (uint32_t n = 0; n < Burst(c); ++n) {
    const bool came = Await(&bus->Own, &frm);
    first = n == 0 ? frm.Data[0] : first;
    if (!came || frm.Identifier != (FEED_REQUEST | 1) || frm.Data[0] != (uint8_t)(first + n)) {
      CheckSay(c, CHECK_FAILED, "can.burst", "frame # of # is missing", n, Burst(c));
      return;
    }
  }
  CheckSay(c, CHECK_OK, "can.burst", "# frames are stored until they are read", Burst(c), 0);
}

static void CheckBurst(const BUS* bus) {
  const STREAM stream = {2 * Burst(bus->Own.Check), Burst(bus->Own.Check), true, false};
  if (bus->Own.Check->Bus == CO_CHECK_FEED) {
    CheckFedBurst(bus);
    return;
  }
  CheckStream(bus, "can.burst", &stream, "# frames are stored until they are read");
}

// Controllers that go on and off the bus.

static void CheckInit(const BUS* bus) {
  CO_IF_FRM frm;
  Init(&bus->Own);
  if (Read(&bus->Own, &frm) > 0) {
    CheckFail(bus->Own.Check, "can.init", "Read returns a frame before Enable");
    return;
  }
  CheckPass(bus->Own.Check, "can.init", "Read returns no frame before Enable");
}

static void CheckEmpty(const BUS* bus) {
  CO_IF_FRM frm;
  for (uint8_t n = 0; n < 10; ++n) {
    const int16_t result = Read(&bus->Own, &frm);
    if (result != 0) {
      CheckFail(bus->Own.Check, "can.empty",
                result < 0 ? "Read returns an error if there is no frame" : "Read returns a frame that was not sent");
      return;
    }
  }
  CheckPass(bus->Own.Check, "can.empty", "Read returns 0 if there is no frame");
}

// Returns true if a frame of the peer is received. Resets the peer, whose controller would repeat an unacknowledged
// frame.
static bool HearsPeer(const BUS* bus) {
  CO_IF_FRM frm;
  Fill(&frm, 0x200, 1, 1);
  (void)Send(&bus->Peer, &frm);
  const bool heard = !IsQuiet(&bus->Own);
  Reset(&bus->Peer);
  return heard;
}

static void CheckOff(const BUS* bus, const char* name) {
  CO_IF_FRM frm;
  Fill(&frm, 0x100, 1, 0);
  if (Send(&bus->Own, &frm) > 0) {
    CheckFail(bus->Own.Check, name, "Send accepts a frame while the controller is off the bus");
    Reset(&bus->Own);
    return;
  }
  if (bus->Own.Check->Bus == CO_CHECK_PEER && HearsPeer(bus)) {
    CheckFail(bus->Own.Check, name, "a frame is received while the controller is off the bus");
    return;
  }
  CheckPass(bus->Own.Check, name, "no frame is sent or received while the controller is off the bus");
}

// Checks that Reset discards the frames received before it, and that frames are transferred afterwards.
static void CheckReset(const BUS* bus) {
  const WAY* const way = &bus->Way[bus->Ways - 1];
  CO_IF_FRM frm;
  Fill(&frm, 0x300, 4, 7);
  for (uint8_t n = 0; n < 3; ++n) {
    (void)Offer(way->From, &frm);
  }
  for (uint32_t turn = CheckQuiet(bus->Own.Check); turn != 0; --turn) {
    CheckIdle(bus->Own.Check);
  }
  Reset(&bus->Own);
  if (!IsQuiet(&bus->Own)) {
    CheckFail(bus->Own.Check, "can.reset", "Reset does not discard received frames");
    return;
  }
  if (PassAll(bus, "can.reset", &frm)) {
    CheckPass(bus->Own.Check, "can.reset", "Reset discards received frames; later frames are transferred");
  }
}

// Checks the calls of a switched bit rate, and of a restart of the node.
static void CheckAgain(const BUS* bus) {
  CO_IF_FRM frm;
  Fill(&frm, 0x300, 5, 9);
  Init(&bus->Own);
  Enable(&bus->Own);
  if (!IsQuiet(&bus->Own)) {
    CheckFail(bus->Own.Check, "can.again", "Read returns a frame that was not sent, after the second Init and Enable");
    return;
  }
  if (bus->Ways == 0 || PassAll(bus, "can.again", &frm)) {
    CheckPass(bus->Own.Check, "can.again", "a second Init and Enable succeed");
  }
}

// Receive filters.

#define FILTER_IDS 200u  // more than controllers have filters

static bool Receives(const BUS* bus, const char* name, uint32_t id) {
  const WAY* const way = &bus->Way[bus->Ways - 1];
  CO_IF_FRM frm;
  Fill(&frm, id & ~way->Echo, 6, 3);
  const char* const wrong = Pass(way, &frm);
  if (wrong != NULL) {
    CheckSay(bus->Own.Check, CHECK_FAILED, name, wrong, id, frm.DLC);
  }
  return wrong == NULL;
}

// Calls Filter like the node does: before Enable, and after every change.
static bool ReceivesAll(const BUS* bus, const char* name, const uint32_t* ids, uint16_t num, uint16_t step) {
  bus->Own.Ex->Filter(bus->Own.Ctx, ids, num);
  for (uint32_t n = 0; n < num; n += step) {
    if (!Receives(bus, name, ids[n])) {
      return false;
    }
  }
  return true;
}

static void CheckFilter(const BUS* bus) {
  static const uint32_t few[] = {0x001, 0x081, 0x185, 0x185, 0x605, 0x67F};
  static const uint32_t others[] = {0x101, 0x201, 0x705};
  static uint32_t many[FILTER_IDS];
  CO_DRIVER_CHECK* const c = bus->Own.Check;
  if (bus->Own.Ex == NULL || bus->Own.Ex->Filter == NULL) {
    CheckSkip(c, "can.filter", "the driver has no Filter function");
    return;
  }
  for (uint32_t n = 0; n < FILTER_IDS; ++n) {
    many[n] = 0x101 + 2 * n;
  }
  Init(&bus->Own);
  bus->Own.Ex->Filter(bus->Own.Ctx, few, 6);
  Enable(&bus->Own);
  if (!ReceivesAll(bus, "can.filter", few, 6, 1) || !ReceivesAll(bus, "can.filter", others, 3, 1) ||
      !ReceivesAll(bus, "can.filter", many, FILTER_IDS, 37)) {
    return;
  }
  (void)ReceivesAll(bus, "can.filter", others, 3, 1);
  Reset(&bus->Own);
  if (Receives(bus, "can.filter", 0x201)) {
    CheckPass(c, "can.filter", "6, 3 and 200 identifiers pass the filter, also after a change and a Reset");
  }
}

static void OpenPeer(const BUS* bus) {
  if (bus->Own.Check->Bus == CO_CHECK_PEER) {
    Init(&bus->Peer);
    Enable(&bus->Peer);
  }
}

static const char* const NeedABus[] = {"can.dlc",   "can.data", "can.id11",  "can.id29",  "can.remote",
                                       "can.order", "can.busy", "can.burst", "can.reset", "can.filter"};

static void CheckTraffic(const BUS* bus) {
  if (bus->Ways == 0) {
    for (size_t n = 0; n < sizeof(NeedABus) / sizeof(NeedABus[0]); ++n) {
      CheckSkip(bus->Own.Check, NeedABus[n], "no bus is connected");
    }
    return;
  }
  CheckLengths(bus);
  CheckData(bus);
  CheckBaseIds(bus);
  CheckExtendedIds(bus);
  CheckRemote(bus);
  CheckOrder(bus);
  CheckBusy(bus);
  CheckBurst(bus);
  CheckReset(bus);
}

static END EndOf(CO_DRIVER_CHECK* c, const CO_IF_DRV* drv, const CO_NODE_EXT* ext) {
  const bool ex = ext != NULL && ext->Can != NULL;
  const END end = {c, drv != NULL ? drv->Can : NULL, ex ? ext->Can : NULL, ex ? ext->CanCtx : NULL};
  return end;
}

static void FindWays(BUS* bus) {
  const CO_CHECK_BUS kind = bus->Own.Check->Bus;
  const WAY alone = {&bus->Own, &bus->Own, kind == CO_CHECK_FEED ? 1u : 0u};
  const WAY out = {&bus->Own, &bus->Peer, 0};
  const WAY in = {&bus->Peer, &bus->Own, 0};
  bus->Way[0] = kind == CO_CHECK_PEER ? out : alone;
  bus->Way[1] = in;
  bus->Ways = kind == CO_CHECK_NO_BUS ? 0 : (kind == CO_CHECK_PEER ? 2 : 1);
}

void CODriverCheckCan(CO_DRIVER_CHECK* check) {
  BUS bus;
  memset(&bus, 0, sizeof(bus));
  bus.Own = EndOf(check, check->Drv, check->Ext);
  bus.Peer = EndOf(check, NULL, check->Peer);
  FindWays(&bus);
  if (bus.Own.Plain == NULL && bus.Own.Ex == NULL) {
    CheckSkip(check, "can", "no driver is set");
    return;
  }
  check->OddResult = false;
  OpenPeer(&bus);
  CheckInit(&bus);
  CheckOff(&bus, "can.off");
  Enable(&bus.Own);
  CheckEmpty(&bus);
  CheckTraffic(&bus);
  CheckAgain(&bus);
  if (bus.Ways != 0) {
    CheckFilter(&bus);
  }
  Close(&bus.Own);
  CheckOff(&bus, "can.close");
  if (check->OddResult) {
    CheckFail(check, "can.result", "Read or Send returns a positive value other than sizeof(CO_IF_FRM)");
  } else {
    CheckPass(check, "can.result", "Read and Send return sizeof(CO_IF_FRM), 0 or a negative value");
  }
}
