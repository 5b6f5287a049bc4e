# What `cmake --install` installs, below one prefix:
#   bin             baraka, baraka-agentd, the controllers
#   lib/baraka      plug-ins of the controllers; the libraries a controller is linked with
#   lib/cmake       find_package(baraka)
#   include/baraka  hal/api and hal/types: what a controller may include
#   lib/systemd     the service of an agent; lib/sysusers.d: its user
#   share/baraka    robots, radios, scenarios, agents; templates of `baraka new-controller`
# No file knows the prefix: programs find the rest from where they are.
include(CMakePackageConfigHelpers)
set(baraka_share share/baraka)
set(package lib/cmake/baraka)

# A program that was just built finds what an installed one does.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/${baraka_share})
foreach(folder config/robots config/radios config/scenarios templates)
  get_filename_component(name ${folder} NAME)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/${baraka_share}/${name}
    SYMBOLIC)
endforeach()

install(TARGETS ${controller_names} RUNTIME DESTINATION bin)
foreach(name IN LISTS controller_names)
  install(TARGETS ${name}_plugin LIBRARY DESTINATION lib/baraka)
endforeach()
foreach(name baraka baraka-agentd)
  if(TARGET ${name})
    install(TARGETS ${name} EXPORT baraka RUNTIME DESTINATION bin)
  endif()
endforeach()
install(TARGETS baraka_determinism hal_types hal_config hal_api hal_exchange hal_runtime idl hal_rtps hal_dds
  EXPORT baraka ARCHIVE DESTINATION lib/baraka)
install(DIRECTORY hal/api hal/types DESTINATION include/baraka/hal FILES_MATCHING PATTERN *.h)

install(DIRECTORY config/ DESTINATION ${baraka_share} PATTERN invalid EXCLUDE
  PATTERN systemd EXCLUDE)
install(FILES config/systemd/baraka-agentd@.service DESTINATION lib/systemd/system)
install(FILES config/systemd/baraka.conf DESTINATION lib/sysusers.d)
install(DIRECTORY templates DESTINATION ${baraka_share} USE_SOURCE_PERMISSIONS)
install(FILES ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/report_page.html DESTINATION ${baraka_share} OPTIONAL)
install(FILES LICENSE DESTINATION share/doc/baraka)

install(EXPORT baraka NAMESPACE baraka:: FILE barakaTargets.cmake DESTINATION ${package})
configure_package_config_file(cmake/barakaConfig.cmake.in ${PROJECT_BINARY_DIR}/barakaConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS baraka_share)
# Before 1.0 the second number may break what the first may later.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/barakaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/barakaConfig.cmake
  ${PROJECT_BINARY_DIR}/barakaConfigVersion.cmake cmake/barakaController.cmake
  DESTINATION ${package})
