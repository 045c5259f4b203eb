// SPDX-License-Identifier: Apache-2.0
#include "driver_check.h"

#include <string.h>

#define LINE_BYTES 160u

typedef struct LINE_T {
  char Text[LINE_BYTES];
  size_t Len;
} LINE;

static void AddChar(LINE* line, char c) {
  if (line->Len < LINE_BYTES - 1) {
    line->Text[line->Len++] = c;
    line->Text[line->Len] = '\0';
  }
}

static void AddText(LINE* line, const char* text) {
  for (; *text != '\0'; ++text) {
    AddChar(line, *text);
  }
}

static void AddNumber(LINE* line, uint32_t number, uint32_t base) {
  uint32_t power = 1;
  while (number / power >= base) {
    power *= base;
  }
  for (; power != 0; power /= base) {
    AddChar(line, "0123456789ABCDEF"[number / power % base]);
  }
}

static void AddReason(LINE* line, const char* reason, uint32_t first, uint32_t second) {
  uint32_t next = first;
  for (; *reason != '\0'; ++reason) {
    if (*reason != '#' && *reason != '$') {
      AddChar(line, *reason);
      continue;
    }
    AddNumber(line, next, *reason == '#' ? 10 : 16);
    next = second;
  }
}

void CheckSay(CO_DRIVER_CHECK* c, CHECK_VERDICT verdict, const char* name, const char* reason, uint32_t first,
              uint32_t second) {
  static const char* const words[] = {"ok ", "not ok ", "skipped "};
  LINE line = {{0}, 0};
  AddText(&line, words[verdict]);
  AddText(&line, name);
  AddText(&line, ": ");
  AddReason(&line, reason, first, second);
  c->Passed = (uint16_t)(c->Passed + (verdict == CHECK_OK));
  c->Failed = (uint16_t)(c->Failed + (verdict == CHECK_FAILED));
  c->Skipped = (uint16_t)(c->Skipped + (verdict == CHECK_SKIPPED));
  c->Print(c->User, line.Text);
}

void CheckIdle(const CO_DRIVER_CHECK* c) {
  if (c->Idle != NULL) {
    c->Idle(c->User);
  }
}

uint32_t CheckPatience(const CO_DRIVER_CHECK* c) { return c->Patience == 0 ? 10000000u : c->Patience; }

uint32_t CheckQuiet(const CO_DRIVER_CHECK* c) {
  const uint32_t part = CheckPatience(c) / (c->Bus == CO_CHECK_FEED ? 10u : 500u);
  return c->Quiet == 0 ? part : c->Quiet;
}

static void PrintSummary(CO_DRIVER_CHECK* c) {
  LINE line = {{0}, 0};
  AddNumber(&line, c->Passed, 10);
  AddText(&line, " passed, ");
  AddNumber(&line, c->Failed, 10);
  AddText(&line, " failed, ");
  AddNumber(&line, c->Skipped, 10);
  AddText(&line, " skipped");
  c->Print(c->User, line.Text);
}

uint16_t CODriverCheck(CO_DRIVER_CHECK* check) {
  check->Passed = 0;
  check->Failed = 0;
  check->Skipped = 0;
  CODriverCheckNvm(check);
  CODriverCheckTimer(check);
  CODriverCheckCan(check);
  PrintSummary(check);
  return check->Failed;
}
