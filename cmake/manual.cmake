# Manual pages and completion for bash, which the programs themselves write from the tables by which they read their
# command lines: <build>/manual/<program>/man1 and completions.
set(manual ${PROJECT_BINARY_DIR}/manual)
set(manual_stamps "")
foreach(program baraka baraka-agentd)
  set(stamp ${manual}/${program}.stamp)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}/${program}
    COMMAND ${program} --write-manual ${manual}/${program}
    COMMAND find ${manual}/${program}/man1 -name "*.1" -exec gzip -9n {} +  # without a time: equal bytes
    COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
    DEPENDS ${program} VERBATIM)
  list(APPEND manual_stamps ${stamp})
endforeach()
add_custom_target(manual ALL DEPENDS ${manual_stamps})
add_dependencies(programs manual)
