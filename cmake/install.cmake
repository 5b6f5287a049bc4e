# What `cmake --install` installs, below one prefix, and which Debian package it goes to:
#   program (baraka)
#     bin             baraka, the controllers, the players of `topics:`
#     lib/baraka      plug-ins of the controllers, what slows programs and what holds their networks
#     share/baraka    robots, radios, scenarios, campaigns, hardware, viewers; templates of `baraka new-controller`;
#                     IDL; the pages of the report and of the view, if they were built
#     share/doc       README, docs, licence
#     share/man       a page for each command; share/bash-completion
#   dev (libbaraka-dev)
#     lib/baraka      the libraries a controller is linked with
#     lib/cmake       find_package(baraka)
#     include/baraka  hal/api and hal/types: what a controller may include
#   agentd (baraka-agentd)
#     bin             baraka-agentd; its manual page and completion as above
#     lib/systemd     the service of an agent; lib/sysusers.d: its user
#   sdf (baraka-sdf)
#     bin             baraka-sdf, if its libraries are there
#   python (python3-baraka)
#     lib/python3     the package baraka, where Debian's Python looks if the prefix is /usr
#     lib/baraka      libbaraka_python.so: Python inside `baraka`
#   doc (baraka-doc)
#     share/doc       the site of docs/, if it was built
# No file knows the prefix: programs find the rest from where they are.
include(CMakePackageConfigHelpers)
set(baraka_share share/baraka)
set(package lib/cmake/baraka)

# A program that was just built finds what an installed one does.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/${baraka_share})
foreach(folder config/robots config/radios config/scenarios config/campaigns config/fleets config/hardware
  config/tasks config/dds config/antennas config/maps config/viewers templates idl)
  get_filename_component(name ${folder} NAME)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/${baraka_share}/${name}
    SYMBOLIC)
endforeach()

install(TARGETS baraka EXPORT baraka RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS baraka_dilate baraka_lockstep LIBRARY DESTINATION lib/baraka COMPONENT program)
install(TARGETS baraka-holder RUNTIME DESTINATION lib/baraka COMPONENT program)
install(TARGETS baraka-topics-cyclonedds baraka-topics-fastdds RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS ${controller_names} RUNTIME DESTINATION bin COMPONENT program)
foreach(name IN LISTS controller_names)
  install(TARGETS ${name}_plugin LIBRARY DESTINATION lib/baraka COMPONENT program)
endforeach()
install(DIRECTORY config/ DESTINATION ${baraka_share} COMPONENT program PATTERN invalid EXCLUDE
  PATTERN systemd EXCLUDE PATTERN doubtful EXCLUDE)
install(DIRECTORY templates DESTINATION ${baraka_share} USE_SOURCE_PERMISSIONS COMPONENT program)
install(DIRECTORY idl DESTINATION ${baraka_share} COMPONENT program FILES_MATCHING PATTERN *.idl PATTERN ros EXCLUDE)
install(FILES ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/report_page.html
  ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/view_page.html DESTINATION ${baraka_share} COMPONENT program OPTIONAL)
install(DIRECTORY ${manual}/baraka/man1 DESTINATION share/man COMPONENT program)
install(DIRECTORY ${manual}/baraka/completions DESTINATION share/bash-completion COMPONENT program)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE DESTINATION share/doc/baraka COMPONENT program)
install(DIRECTORY docs DESTINATION share/doc/baraka COMPONENT program OPTIONAL)

if(TARGET python_package)
  install(TARGETS baraka_python LIBRARY DESTINATION lib/baraka COMPONENT python)
  install(TARGETS python_hal python_process python_simulator LIBRARY DESTINATION lib/python3/dist-packages/baraka COMPONENT python)
  install(DIRECTORY python/baraka/ DESTINATION lib/python3/dist-packages/baraka COMPONENT python FILES_MATCHING PATTERN *.py)
endif()
install(TARGETS baraka-agentd RUNTIME DESTINATION bin COMPONENT agentd)
install(DIRECTORY ${manual}/baraka-agentd/man1 DESTINATION share/man COMPONENT agentd)
install(DIRECTORY ${manual}/baraka-agentd/completions DESTINATION share/bash-completion COMPONENT agentd)
install(FILES config/systemd/baraka-agentd@.service DESTINATION lib/systemd/system COMPONENT agentd)
install(FILES config/systemd/baraka.conf DESTINATION lib/sysusers.d COMPONENT agentd)

if(BARAKA_SDF)
  install(TARGETS baraka-sdf RUNTIME DESTINATION bin COMPONENT sdf)
endif()

install(DIRECTORY ${site}/ DESTINATION share/doc/baraka-doc/html COMPONENT doc OPTIONAL)

install(TARGETS baraka_determinism hal_types hal_api hal_node_exchange hal_files_config hal_rtps idl
  gateway_process gateway_guard gateway_domain gateway_runtime gateway_exchange
  EXPORT baraka ARCHIVE DESTINATION lib/baraka COMPONENT dev)
install(DIRECTORY hal/api hal/types DESTINATION include/baraka/hal COMPONENT dev
  FILES_MATCHING PATTERN *.h)
install(EXPORT baraka NAMESPACE baraka:: FILE barakaTargets.cmake DESTINATION ${package}
  COMPONENT dev)
configure_package_config_file(cmake/barakaConfig.cmake.in ${PROJECT_BINARY_DIR}/barakaConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS baraka_share)
# Before 1.0 the second number may break what the first may later.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/barakaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/barakaConfig.cmake
  ${PROJECT_BINARY_DIR}/barakaConfigVersion.cmake cmake/barakaController.cmake
  DESTINATION ${package} COMPONENT dev)
