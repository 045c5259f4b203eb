// SPDX-License-Identifier: Apache-2.0
#include "project/project.hpp"

#include <fmt/format.h>

#include <string_view>

namespace lexican::codict::project {

namespace {

constexpr const char* cmake_lists = R"CMAKE(cmake_minimum_required(VERSION 3.25)
project(@NAME@ LANGUAGES C CXX)

# Lexican: its sources (-DLEXICAN=DIRECTORY), else an installed package.
set(LEXICAN "" CACHE PATH "Directory of the sources of Lexican; empty: find_package(lexican)")
@SETTINGS@if(LEXICAN)
  if(NOT EXISTS ${LEXICAN}/cmake/lexican_generate.cmake)
    message(FATAL_ERROR "no sources of Lexican in ${LEXICAN}: give their directory with -DLEXICAN=DIRECTORY")
  endif()
  set(LEXICAN_PRESET full CACHE STRING "Configuration of Lexican: minimal, slave or full")
  set(LEXICAN_DRIVERS ON)
  set(LEXICAN_TESTS OFF)
  set(LEXICAN_DEMO OFF)
  add_subdirectory(${LEXICAN} lexican EXCLUDE_FROM_ALL)
else()
  find_package(lexican REQUIRED)
endif()

# The device: the object dictionary and what the application defines for it.
add_library(@NAME@_device OBJECT@APPLICATION@)
target_link_libraries(@NAME@_device PUBLIC lexican::lexican)
find_program(LEXICAN_CODICT codict HINTS ${LEXICAN_CODICT_HINT} DOC "The program codict, for the machine that builds")
if(LEXICAN_CODICT)
  lexican_generate(TARGET @NAME@_device DESCRIPTION "@CMAKE_DESCRIPTION@" NAME @DICT@ LANGUAGE @LANGUAGE@
    OUTPUT_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/generated@FORCED@)
else()
  # Without codict, the generated files are compiled as they are; they do not follow changes of the description.
  message(STATUS "no codict was found (PATH, -DLEXICAN_CODICT=FILE): changes of @DESCRIPTION@ have no effect")
  target_sources(@NAME@_device PRIVATE generated/@DICT@_od.@EXT@)
  target_include_directories(@NAME@_device PUBLIC generated)
endif()

# The program, on a simulated bus.
enable_testing()
if(TARGET lexican::lexican_can_virtual)
  add_executable(@NAME@_node main.@EXT@)
  target_link_libraries(@NAME@_node PRIVATE @NAME@_device lexican::lexican_can_virtual lexican::lexican_nvm_ram
    lexican::lexican_timer_software)
  add_test(NAME @NAME@_node COMMAND @NAME@_node)
endif()
)CMAKE";

constexpr const char* main_source =
    R"TEXT(/* A CANopen node on a simulated bus. The program prints all frames of three seconds; its exit status is 0 if the node
   has sent what it should. For a real device, replace the drivers: see docs/porting.md of Lexican. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

@INCLUDES@
#define NODE_ID @NODE_ID@
#define BIT_RATE 250000
#define RUN_TIME 3000 /* ms */
#define CYCLE 100     /* ms */

static CO_NODE Node;
static CO_NODE_SPEC Spec;
static CO_NODE_EXT Drivers;
CO_SDO_BUFFER(SdoBuffer);
@STORAGE_DATA@static bool HasBootUp;
@TPDO_DATA@
static void PrintFrame(void* clock, const CO_IF_FRM* frame, const char* sender) {
  const CO_VIRTUAL_CLOCK* time = (const CO_VIRTUAL_CLOCK*)clock;
  printf("%5u ms  %-6s  %03X ", (unsigned)COVirtualClockNow(time), sender, (unsigned)frame->Identifier);
  for (uint8_t n = 0; n < frame->DLC && n < 8; ++n) {
    printf(" %02X", frame->Data[n]);
  }
  if (frame->Identifier == 0x700u + NODE_ID && frame->Data[0] == 0) {
    HasBootUp = true;
    printf("  boot-up");
  }
@TPDO_CHECK@  printf("\n");
}

static void SendAsMaster(CO_VIRTUAL_PORT* master, uint32_t identifier, const void* data, uint8_t size) {
  CO_IF_FRM frame;
  memset(&frame, 0, sizeof frame);
  frame.Identifier = identifier;
  frame.DLC = size;
  memcpy(frame.Data, data, size);
  COVirtualPortSend(master, &frame);
}

/* Called each CYCLE: the place for the application. The variables of the dictionary are in @DICT@_ram. */
static void RunApplication(CO_VIRTUAL_PORT* master) {
@TPDO_RUN@  SendAsMaster(master, 0x080, "", 0); /* SYNC */
}

int main(void) {
  CO_VIRTUAL_BUS* bus = COVirtualBusNew();
  CO_VIRTUAL_CLOCK* clock = COVirtualClockNew();
  CO_VIRTUAL_PORT* master = COVirtualBusAttach(bus, "master");
  const uint8_t start[] = {1, NODE_ID};
  char text[CO_NODE_ERR_TEXT];
  COVirtualBusTrace(bus, PrintFrame, clock);
  COVirtualPortEnable(master, 0);

  Spec.NodeId = NODE_ID;
  Spec.Baudrate = BIT_RATE;
  Spec.Dict = (CO_OBJ*)@DICT@_od;
  Spec.DictLen = @PREFIX@_OD_NUM;
  Spec.TmrFreq = 1000; /* a tick is a millisecond */
  Spec.SdoBuf = SdoBuffer;
  Drivers.Size = sizeof Drivers;
  Drivers.Can = &COVirtualBusDriver;
  Drivers.CanCtx = COVirtualBusAttach(bus, "node");
  Drivers.Timer = &COVirtualTimerDriver;
  Drivers.TimerCtx = COVirtualTimerNew(clock);
  Drivers.SdoBufLen = SdoBufferLen;
@STORAGE_INIT@
  CONodeInitEx(&Node, &Spec, &Drivers);
  CONodeStart(&Node);
  if (CONodeGetErrText(&Node, text, sizeof text) != CO_ERR_NONE) {
    puts(text);
    return 1;
  }
  SendAsMaster(master, 0x000, start, sizeof start); /* NMT: start */
  for (int ms = 0; ms < RUN_TIME; ++ms) {
    CONodeProcess(&Node);
    COTmrService(&Node.Tmr);
    COTmrProcess(&Node.Tmr);
    if (ms % CYCLE == CYCLE - 1) {
      RunApplication(master);
    }
    COVirtualClockAdvance(clock, 1);
  }
  return @RESULT@ ? 0 : 1;
}
)TEXT";

constexpr const char* readme = R"TEXT(# @NAME@

A CANopen node that is generated from `@DESCRIPTION@`, with Lexican, a CANopen stack. It runs on a
simulated bus without changes:

```sh
cmake -S . -B build -DLEXICAN=DIRECTORY_OF_LEXICAN
cmake --build build
build/@NAME@_node        # prints the frames: boot-up@TPDO_WORDS@
ctest --test-dir build   # runs it as a test
```

With an installed Lexican, replace `-DLEXICAN=…` by `-DCMAKE_PREFIX_PATH=` and the directory of the installation.

| File | Content |
|---|---|
| `@DESCRIPTION@` | the description of the device; change objects here |
| `generated/` | the object dictionary. The build runs `codict gen` again after a change if codict is found; by hand: `codict gen "@DESCRIPTION@" -o generated --name @DICT@@GEN_LANGUAGE@@GEN_FORCE@` |
| `main.@EXT@` | the node and its main loop; the application's code belongs into `RunApplication()` |
@APPLICATION_ROW@| `CMakeLists.txt` | the build, and a test |

Before the device is shipped: enter vendor-ID, product code and names in the description, set the node-ID (`NODE_ID`), and
replace the drivers of the simulated bus by those of the hardware (`docs/porting.md` of Lexican).
)TEXT";

using Words = std::vector<std::pair<std::string_view, std::string>>;

// Replaces @WORD@ by its value, for each word in the list. Replacements are not searched for the same word again.
std::string filled(std::string text, const Words& words) {
  for (const auto& [word, value] : words) {
    const std::string mark = fmt::format("@{}@", word);
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size())) {
      text.replace(at, mark.size(), value);
    }
  }
  return text;
}

std::string upper(std::string text) {
  for (char& c : text) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return text;
}

// Escapes characters that CMake would interpret in a quoted argument.
std::string cmake_quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    quoted += c == '"' || c == '$' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return quoted;
}

std::string settings_of(const Options& options) {
  std::string definitions;
  for (const auto& [name, value] : options.settings) {
    definitions += fmt::format(" {}={}", name, value);
  }
  return definitions.empty()
             ? ""
             : fmt::format(
                   "# The dictionary needs more than the default configuration; library and application must agree.\n"
                   "add_compile_definitions({})\n",
                   definitions.substr(1));
}

Words words_of(const Options& options) {
  const bool has_tpdo = options.tpdo != 0;
  const std::string extension = options.is_cpp ? "cpp" : "c";
  return {
      {"SETTINGS", settings_of(options)},
      {"APPLICATION", options.has_application ? " application." + extension : ""},
      {"APPLICATION_ROW", options.has_application
                              ? "| `application." + extension + "` | what the dictionary leaves to the application |\n"
                              : ""},
      {"INCLUDES",
       "#include \"@DICT@_od.h\"\n"
       "#include \"co_can_virtual.h\"\n"
       "#include \"co_nvm_ram.h\"\n"
       "#include \"co_virtual_clock.h\"\n"},
      {"STORAGE_DATA", options.has_storage ? "static uint8_t Memory[@PREFIX@_PARA_END];\n"
                                             "static CO_NVM_RAM Nvm = {Memory, sizeof Memory};\n"
                                           : ""},
      {"STORAGE_INIT",
       options.has_storage ? "  CONvmRamClear(&Nvm);\n  Drivers.Nvm = &RamNvmDriver;\n  Drivers.NvmCtx = &Nvm;\n" : ""},
      {"TPDO_DATA", has_tpdo ? "static bool HasTpdo;\n" : ""},
      {"TPDO_CHECK", has_tpdo ? fmt::format("  if (frame->Identifier == 0x{:03X}u) {{\n    HasTpdo = true;\n"
                                            "    printf(\"  TPDO {}\");\n  }}\n",
                                            options.tpdo_cob_id, options.tpdo)
                              : ""},
      {"TPDO_RUN", has_tpdo ? fmt::format("  COTPdoTrigPdo(Node.TPdo, {});\n", options.tpdo - 1) : ""},
      {"TPDO_WORDS", has_tpdo ? fmt::format(", TPDO {}", options.tpdo) : ""},
      {"RESULT", has_tpdo ? "HasBootUp && HasTpdo" : "HasBootUp"},
      {"FORCED", options.is_forced
                     ? "\n    # The description has errors. Remove these options when they are corrected.\n"
                       "    VERIFY OFF OPTIONS --force"
                     : ""},
      {"GEN_LANGUAGE", options.is_cpp ? " --language c++" : ""},
      {"GEN_FORCE", options.is_forced ? " --force" : ""},
      {"NAME", options.name},
      {"DICT", options.dictionary},
      {"PREFIX", upper(options.dictionary)},
      {"CMAKE_DESCRIPTION", cmake_quoted(options.description)},
      {"DESCRIPTION", options.description},
      {"LANGUAGE", options.is_cpp ? "CXX" : "C"},
      {"EXT", extension},
      {"NODE_ID", std::to_string(options.node_id)},
  };
}

}  // namespace

std::vector<File> files(const Options& options) {
  const Words words = words_of(options);
  return {{"CMakeLists.txt", filled(cmake_lists, words)},
          {options.is_cpp ? "main.cpp" : "main.c", filled(main_source, words)},
          {"README.md", filled(readme, words)}};
}

}  // namespace lexican::codict::project
