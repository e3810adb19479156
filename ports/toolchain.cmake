# -DHYST_CORE=NAME: cross-compiles for a core of cores.txt.
set(HYST_CORE "" CACHE STRING "A core of ports/cores.txt")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES HYST_CORE)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/cores.txt hyst_core_lines REGEX "^[a-z0-9]")
set(hyst_core_line ${hyst_core_lines})
list(FILTER hyst_core_line INCLUDE REGEX "^${HYST_CORE} *[|]")
if(HYST_CORE STREQUAL "" OR hyst_core_line STREQUAL "")
  string(REGEX REPLACE " *[|][^;]*" "" hyst_core_names "${hyst_core_lines}")
  message(FATAL_ERROR "HYST_CORE is '${HYST_CORE}': expected one of ${hyst_core_names}")
endif()
string(REGEX REPLACE " *[|] *" ";" hyst_core_line "${hyst_core_line}")
list(POP_FRONT hyst_core_line
  hyst_core_name CMAKE_C_COMPILER hyst_core_flags hyst_core_board hyst_core_code hyst_core_data HYST_CORE_PS_PER_TICK)
string(REPLACE " " ";" hyst_core_memory "${hyst_core_code} ${hyst_core_data}")
list(POP_FRONT hyst_core_memory HYST_CORE_CODE HYST_CORE_CODE_BYTES HYST_CORE_DATA HYST_CORE_DATA_BYTES)

set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR ${HYST_CORE})
# Without a C library nothing links before the port's own start-up code is there.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_FLAGS_INIT
  "${hyst_core_flags} -ffp-contract=off -ffreestanding -ffunction-sections -fdata-sections")
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of a release build")
set(CMAKE_EXECUTABLE_SUFFIX_C .elf)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_CROSSCOMPILING_EMULATOR sh ${CMAKE_CURRENT_LIST_DIR}/qemu_run.sh ${HYST_CORE})
