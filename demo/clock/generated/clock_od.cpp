// Made by codict gen from clock.xdd: do not edit.
#include "clock_od.h"

#include <stddef.h>
#include <string.h>

#include "co/dictionary.hpp"

// Type of a number of up to 32 bits with limits: Plain does the access, a value outside Low and High is refused.
// Order says how Low and High are compared: 0 unsigned, 1 signed, 2 real.
typedef struct {
  CO_OBJ_TYPE Type;
  const CO_OBJ_TYPE *Plain;
  uint32_t Low;
  uint32_t High;
  uint8_t Order;
} limited32_t;

static const limited32_t *limited32(const CO_OBJ *obj) { return (const limited32_t *)(const void *)obj->Type; }

static uint32_t limited32_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {
  return limited32(obj)->Plain->Size(obj, node, width);
}

static CO_ERR limited32_init(CO_OBJ *obj, CO_NODE *node) {
  const CO_OBJ_INIT_FUNC init = limited32(obj)->Plain->Init;
  return init == NULL ? CO_ERR_NONE : init(obj, node);
}

static CO_ERR limited32_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  return limited32(obj)->Plain->Read(obj, node, buffer, size);
}

// Returns the rank of a number in the CPU's byte order; the lowest number has rank 0. The bits of a positive real grow
// with its value, those of a negative one decrease; NaN has the highest rank.
static uint32_t limited32_rank(uint32_t bits, uint32_t size, uint8_t order) {
  const uint32_t highest = (uint32_t)1 << 31;
  const uint32_t sign = (uint32_t)1 << (8u * size - 1u);
  if (order == 0u) {
    return bits;
  }
  if (order == 1u) {
    return ((bits ^ sign) - sign) ^ highest;
  }
  if ((bits & ~highest) == 0u) {
    return highest;
  }
  return (bits & highest) != 0u ? ~bits : bits | highest;
}

static CO_ERR limited32_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  const limited32_t *const type = limited32(obj);
  const uint8_t *const byte = (const uint8_t *)buffer;
  uint32_t bits = 0;
  uint32_t rank;
  uint32_t n;
  if (size == 0u || size > sizeof bits) {
    return CO_ERR_BAD_ARG;
  }
  for (n = 0; n < size; ++n) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bits = (uint32_t)(bits << 8) | byte[n];
#else
    bits = (uint32_t)(bits << 8) | byte[size - 1u - n];
#endif
  }
  rank = limited32_rank(bits, size, type->Order);
  if (rank < limited32_rank(type->Low, sizeof bits, type->Order)) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_LOW);
    return CO_ERR_OBJ_RANGE;
  }
  if (rank > limited32_rank(type->High, sizeof bits, type->Order)) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_HIGH);
    return CO_ERR_OBJ_RANGE;
  }
  return type->Plain->Write(obj, node, buffer, size);
}

// 2101h sub 0: -720 to 840
static const limited32_t limits_1 = {{limited32_size, limited32_init, limited32_read, limited32_write, NULL}, CO_TSIGNED16, 0xFFFFFD30u, 0x348u, 1};

// A string in a storage group: its length is stored, too.
typedef struct {
  CO_OBJ_STR_RW String;
  uint32_t *Length;
  const CO_OBJ_TYPE *Plain;
} stored_string_t;

static const CO_OBJ_TYPE *stored_string(CO_OBJ *obj) {
  stored_string_t *const stored = (stored_string_t *)obj->Data;
  stored->String.Size = *stored->Length;
  return stored->Plain;
}

static uint32_t stored_string_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {
  return stored_string(obj)->Size(obj, node, width);
}

static CO_ERR stored_string_init(CO_OBJ *obj, CO_NODE *node) { return stored_string(obj)->Init(obj, node); }

static CO_ERR stored_string_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  return stored_string(obj)->Read(obj, node, buffer, size);
}

static CO_ERR stored_string_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  const CO_ERR error = stored_string(obj)->Write(obj, node, buffer, size);
  stored_string_t *const stored = (stored_string_t *)obj->Data;
  *stored->Length = stored->String.Size;
  return error;
}

static CO_ERR stored_string_reset(CO_OBJ *obj, CO_NODE *node, uint32_t position) {
  return stored_string(obj)->Reset(obj, node, position);
}

static const CO_OBJ_TYPE stored_string_type = {stored_string_size, stored_string_init, stored_string_read,
                                               stored_string_write, stored_string_reset};

static const uint8_t text_1008_0[] = "Lexican demo clock";

clock_ram_t clock_ram;
static const clock_ram_t clock_ram_default = {
    {{0, text_1008_0}},  // od_1008_0
    {0u},  // od_1003_1
    {0u},  // od_1003_2
    {0u},  // od_1003_3
    {0u},  // od_1003_4
    {1u},  // od_1018_4
    {0u},  // od_1001_0
    {0u},  // od_1003_0
    {0u},  // od_2100_1
    {0u},  // od_2100_2
    {0u},  // od_2100_3
    {128u},  // od_1005_0
    {0u},  // od_1006_0
    {0u},  // od_100C_0
    {1000u},  // od_1017_0
    {1000u},  // od_1800_3
    {0u},  // od_1800_5
    {0u},  // od_100D_0
    {255u},  // od_1400_2
    {255u},  // od_1800_2
};

clock_settings_t clock_settings;
static const clock_settings_t clock_settings_default = {
    {0u},  // od_1020_1
    {0u},  // od_1020_2
    0,  // od_2201_0_length
    {0},  // od_2101_0
    {""},  // od_2201_0
    {0},
};

static stored_string_t string_2201_0 = {{0, 0, 32, (uint8_t *)clock_settings.od_2201_0}, &clock_settings.od_2201_0_length, CO_TVISIBLE_STRING};
const CO_PARA clock_settings_para = {CLOCK_SETTINGS_OFFSET, sizeof clock_settings, &clock_settings, &clock_settings_default, CO_RESET_NODE, NULL, CO_PARA___E | CO_PARA_VERSION(CLOCK_SETTINGS_LAYOUT), 8, 0};

static uint8_t has_defaults;  // CONodeInit() or clock_set_defaults() was called

void clock_set_defaults(void) {
  clock_ram = clock_ram_default;
  clock_settings = clock_settings_default;
  has_defaults = 1;
}

// Called by CONodeInit() and at each NMT reset. Variables that the network cannot write are set once.
static CO_ERR set_power_on_values(CO_OBJ *end, CO_NODE *node, uint32_t reset) {
  const size_t written = reset == CO_RESET_NODE ? offsetof(clock_ram_t, od_2100_1) : offsetof(clock_ram_t, od_1005_0);
  const size_t first = has_defaults != 0 ? written : 0;
  (void)end;
  (void)node;
  (void)reset;
  memcpy((uint8_t *)&clock_ram + first, (const uint8_t *)&clock_ram_default + first, sizeof clock_ram - first);
  has_defaults = 1;
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE power_on_type = {NULL, NULL, NULL, NULL, set_power_on_values};

constexpr CO_OBJ clock_od[CLOCK_OD_NUM] = {
    {CLOCK_1000_0 | CO_OBJ_D___R_, CO_TUNSIGNED32, (CO_DATA)(0u)},
    {CLOCK_1001_0 | CO_OBJ____PR_, CO_TUNSIGNED8, (CO_DATA)(&clock_ram.od_1001_0)},
    {CLOCK_1003_0 | CO_OBJ_____RW, CO_TEMCY_HIST, (CO_DATA)(&clock_ram.od_1003_0)},
    {CLOCK_1003_1 | CO_OBJ_____R_, CO_TEMCY_HIST, (CO_DATA)(&clock_ram.od_1003_1)},
    {CLOCK_1003_2 | CO_OBJ_____R_, CO_TEMCY_HIST, (CO_DATA)(&clock_ram.od_1003_2)},
    {CLOCK_1003_3 | CO_OBJ_____R_, CO_TEMCY_HIST, (CO_DATA)(&clock_ram.od_1003_3)},
    {CLOCK_1003_4 | CO_OBJ_____R_, CO_TEMCY_HIST, (CO_DATA)(&clock_ram.od_1003_4)},
    {CLOCK_1005_0 | CO_OBJ_____RW, CO_TSYNC_ID, (CO_DATA)(&clock_ram.od_1005_0)},
    {CLOCK_1006_0 | CO_OBJ_____RW, CO_TSYNC_CYCLE, (CO_DATA)(&clock_ram.od_1006_0)},
    {CLOCK_1008_0 | CO_OBJ_____R_, CO_TSTRING, (CO_DATA)(&clock_ram.od_1008_0)},
    {CLOCK_1009_0 | CO_OBJ_____R_, CO_TSTRING, (CO_DATA)(&clock_1009_0)},
    {CLOCK_100A_0 | CO_OBJ_____R_, CO_TSTRING, (CO_DATA)(&clock_100A_0)},
    {CLOCK_100C_0 | CO_OBJ_____RW, CO_TUNSIGNED16, (CO_DATA)(&clock_ram.od_100C_0)},
    {CLOCK_100D_0 | CO_OBJ_____RW, CO_TUNSIGNED8, (CO_DATA)(&clock_ram.od_100D_0)},
    {CLOCK_1010_0 | CO_OBJ_D___R_, CO_TPARA_STORE, (CO_DATA)(1u)},
    {CLOCK_1010_1 | CO_OBJ_____RW, CO_TPARA_STORE, (CO_DATA)(&clock_settings_para)},
    {CLOCK_1011_0 | CO_OBJ_D___R_, CO_TPARA_RESTORE, (CO_DATA)(1u)},
    {CLOCK_1011_1 | CO_OBJ_____RW, CO_TPARA_RESTORE, (CO_DATA)(&clock_settings_para)},
    {CLOCK_1014_0 | CO_OBJ_DN__R_, CO_TEMCY_ID, (CO_DATA)(128u)},
    {CLOCK_1017_0 | CO_OBJ_____RW, CO_THB_PROD, (CO_DATA)(&clock_ram.od_1017_0)},
    {CLOCK_1018_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(4u)},
    {CLOCK_1018_1 | CO_OBJ_D___R_, CO_TUNSIGNED32, (CO_DATA)(0u)},
    {CLOCK_1018_2 | CO_OBJ_D___R_, CO_TUNSIGNED32, (CO_DATA)(49420u)},
    {CLOCK_1018_3 | CO_OBJ_D___R_, CO_TUNSIGNED32, (CO_DATA)(1u)},
    {CLOCK_1018_4 | CO_OBJ_____R_, CO_TUNSIGNED32, (CO_DATA)(&clock_ram.od_1018_4)},
    {CLOCK_1020_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(2u)},
    {CLOCK_1020_1 | CO_OBJ_____RW, CO_TVERIFY_CONFIG, (CO_DATA)(&clock_settings.od_1020_1)},
    {CLOCK_1020_2 | CO_OBJ_____RW, CO_TVERIFY_CONFIG, (CO_DATA)(&clock_settings.od_1020_2)},
    {CLOCK_1200_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(2u)},
    {CLOCK_1200_1 | CO_OBJ_DN__R_, CO_TSDO_ID, (CO_DATA)(1536u)},
    {CLOCK_1200_2 | CO_OBJ_DN__R_, CO_TSDO_ID, (CO_DATA)(1408u)},
    {CLOCK_1400_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(2u)},
    {CLOCK_1400_1 | CO_OBJ_DN__R_, CO_TPDO_ID, (CO_DATA)(512u)},
    {CLOCK_1400_2 | CO_OBJ_____RW, CO_TPDO_TYPE, (CO_DATA)(&clock_ram.od_1400_2)},
    {CLOCK_1600_0 | CO_OBJ_D___R_, CO_TPDO_NUM, (CO_DATA)(3u)},
    {CLOCK_1600_1 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000108u)},
    {CLOCK_1600_2 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000208u)},
    {CLOCK_1600_3 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000308u)},
    {CLOCK_1800_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(5u)},
    {CLOCK_1800_1 | CO_OBJ_DN__R_, CO_TPDO_ID, (CO_DATA)(0x40000180u)},
    {CLOCK_1800_2 | CO_OBJ_____RW, CO_TPDO_TYPE, (CO_DATA)(&clock_ram.od_1800_2)},
    {CLOCK_1800_3 | CO_OBJ_____RW, CO_TPDO_INHIBIT, (CO_DATA)(&clock_ram.od_1800_3)},
    {CLOCK_1800_5 | CO_OBJ_____RW, CO_TPDO_EVENT, (CO_DATA)(&clock_ram.od_1800_5)},
    {CLOCK_1A00_0 | CO_OBJ_D___R_, CO_TPDO_NUM, (CO_DATA)(3u)},
    {CLOCK_1A00_1 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000108u)},
    {CLOCK_1A00_2 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000208u)},
    {CLOCK_1A00_3 | CO_OBJ_D___R_, CO_TPDO_MAP, (CO_DATA)(0x21000308u)},
    {CLOCK_2100_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(3u)},
    {CLOCK_2100_1 | CO_OBJ___APRW, &clock_2100_1_type, (CO_DATA)(&clock_ram.od_2100_1)},
    {CLOCK_2100_2 | CO_OBJ___APRW, &clock_2100_2_type, (CO_DATA)(&clock_ram.od_2100_2)},
    {CLOCK_2100_3 | CO_OBJ___APRW, &clock_2100_3_type, (CO_DATA)(&clock_ram.od_2100_3)},
    {CLOCK_2101_0 | CO_OBJ_____RW, &limits_1.Type, (CO_DATA)(&clock_settings.od_2101_0)},
    {CLOCK_2200_0 | CO_OBJ_____RW, CO_TDOMAIN, (CO_DATA)(&clock_2200_0)},
    {CLOCK_2201_0 | CO_OBJ_____RW, &stored_string_type, (CO_DATA)(&string_2201_0)},
    {CO_DEFAULTS_KEY, &power_on_type, (CO_DATA)(0)},
};

// Checks by the compiler: the order of the table,
CO_OD_CHECK(clock_od);
// the layout of what is stored,
static_assert(offsetof(clock_settings_t, od_1020_1) == 0 && sizeof clock_settings.od_1020_1 == 4, "od_1020_1");
static_assert(offsetof(clock_settings_t, od_1020_2) == 4 && sizeof clock_settings.od_1020_2 == 4, "od_1020_2");
static_assert(offsetof(clock_settings_t, od_2201_0_length) == 8 && sizeof clock_settings.od_2201_0_length == 4, "od_2201_0_length");
static_assert(offsetof(clock_settings_t, od_2101_0) == 12 && sizeof clock_settings.od_2101_0 == 2, "od_2101_0");
static_assert(offsetof(clock_settings_t, od_2201_0) == 14 && sizeof clock_settings.od_2201_0 == 33, "od_2201_0");
static_assert(sizeof(clock_settings_t) == 48, "clock_settings");
// default values within their limits,
static_assert(0 >= -720, "2101h sub 0");
static_assert(0 <= 840, "2101h sub 0");
// and what PDOs map.
static_assert(8 + 8 + 8 <= 64 && 3 <= CO_PDO_MAP_N, "1600h");
static_assert(8 + 8 + 8 <= 64 && 3 <= CO_PDO_MAP_N, "1A00h");
