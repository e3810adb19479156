# The host's ctest entries target.<core>_<what>: what is built for the cores of ports/cores.txt and run under emulation.
# 77: skipped aloud, tools are missing or HYST_HOST_ONLY=1 is set.
function(hyst_target_test core what script)
  add_test(NAME target.${core}_${what}
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${PROJECT_SOURCE_DIR}
    ${CMAKE_CURRENT_BINARY_DIR}/target/${core} ${ARGN})
  # A core's tests share its build folder, so that the library is built once.
  set_tests_properties(target.${core}_${what} PROPERTIES
    SKIP_RETURN_CODE 77 TIMEOUT 600 RESOURCE_LOCK target_${core})
endfunction()

# A generated model, and one by hand whose golden values follow from the equations with pencil and paper.
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/target)
set(film_source ${PROJECT_SOURCE_DIR}/host_tools/demo/vo2_film.json)
foreach(scalar f32 q31 q15)
  set(film_${scalar} ${CMAKE_CURRENT_BINARY_DIR}/target/vo2_film_${scalar}.h)
  add_custom_command(OUTPUT ${film_${scalar}} DEPENDS hyst_command ${film_source} VERBATIM
    COMMAND hyst_command emit ${film_source} --scalar ${scalar} --symbol vo2_film -o ${film_${scalar}})
  hyst_self_test(self_test_film_${scalar} ${film_${scalar}} vo2_film ${scalar})
  target_sources(self_test_film_${scalar} PRIVATE ${film_${scalar}})
  add_test(NAME ports.host_self_test_${scalar} COMMAND self_test_film_${scalar})
endforeach()
set(hand_model ${CMAKE_CURRENT_SOURCE_DIR}/support/hand_model.h)
hyst_self_test(self_test_hand ${hand_model} hand f32)
add_test(NAME ports.host_self_test_hand COMMAND self_test_hand)

# The super-loop example, on this machine and with a real interrupt.
set(actuator_header ${CMAKE_CURRENT_BINARY_DIR}/target/actuator.h)
add_custom_command(OUTPUT ${actuator_header} DEPENDS hyst_command ${film_source} VERBATIM
  COMMAND hyst_command emit ${film_source} --symbol actuator -o ${actuator_header})
hyst_example_superloop(example_superloop_host ${actuator_header})
add_test(NAME ports.host_superloop COMMAND example_superloop_host)
hyst_target_test(cortex_m4f superloop target/superloop.sh cortex_m4f ${actuator_header}
  $<TARGET_FILE:example_superloop_host>)

# One core of each floating-point unit, and one without, also run the long tests against the double model.
set(property_cores cortex_m4f cortex_m55 rv32imc)
file(STRINGS ${PROJECT_SOURCE_DIR}/ports/cores.txt core_lines REGEX "^[a-z0-9]")
foreach(core_line ${core_lines})
  string(REGEX REPLACE " *[|].*" "" core ${core_line})
  foreach(scalar f32 q31 q15)
    hyst_target_test(${core} self_test_${scalar} ports/same_bits.sh ${film_${scalar}} vo2_film
      $<TARGET_FILE:self_test_film_${scalar}> ${core} ${scalar})
  endforeach()
  hyst_target_test(${core} hand_model ports/same_bits.sh ${hand_model} hand $<TARGET_FILE:self_test_hand> ${core})
  hyst_target_test(${core} freestanding target/freestanding.sh ${core})
  hyst_target_test(${core} unit target/unity.sh ${core} unit)
  if(core IN_LIST property_cores)
    hyst_target_test(${core} property target/unity.sh ${core} property)
  endif()
endforeach()

# What stands in the README is what is measured.
add_test(NAME target.cost_table
  COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/target/cost_table.sh --hyst $<TARGET_FILE:hyst_command>
  --check ${PROJECT_SOURCE_DIR}/README.md)
set_tests_properties(target.cost_table PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
