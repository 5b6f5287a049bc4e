# The target `packages`: Debian packages in <build>/packages, by CPack, those of Python and baraka-sdf where their libraries are, and
# baraka-doc where the site was built. What they need of other
# packages is computed by dpkg-shlibdeps, but for the headers that libbaraka-dev leads to.
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
    GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_CONTACT "The BARAKA authors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL program dev agentd doc)
if(TARGET python_package)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(BARAKA_SDF)
  list(APPEND CPACK_COMPONENTS_ALL sdf)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME baraka)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "simulator and middleware of networked mobile robots
Robots and fixed motes that talk over an IEEE 802.11 radio, in one world with one clock. Controllers
are programs that talk Fast DDS; the same file drives a simulated robot and a real one.

With scenarios, robots, radios, controllers, and templates for controllers of one's own.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS zstd)  # with which tar reads capsules
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-baraka, baraka-sdf, libbaraka-dev, baraka-doc")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libbaraka-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "what controllers for BARAKA are built with
Headers, static libraries and the CMake package that `baraka new-controller` projects find.")
# cmake/barakaConfig.cmake.in finds these.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "baraka (= ${PROJECT_VERSION}), g++, cmake (>= 3.25), ninja-build | make, pkg-config, \
libexpected-dev, libfmt-dev, libyaml-cpp-dev, libfastcdr-dev, libfastrtps-dev, libsleef-dev")

set(CPACK_DEBIAN_AGENTD_PACKAGE_NAME baraka-agentd)
set(CPACK_DEBIAN_AGENTD_PACKAGE_SECTION net)
set(CPACK_DEBIAN_AGENTD_DESCRIPTION "daemon that lets BARAKA's controllers drive a real robot or mote
`systemctl enable --now baraka-agentd@r0` serves the agent of /etc/baraka/r0.yaml.")
set(CPACK_DEBIAN_AGENTD_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_AGENTD_PACKAGE_DEPENDS "baraka (= ${PROJECT_VERSION})")  # robots, controllers
set(CPACK_DEBIAN_AGENTD_PACKAGE_RECOMMENDS systemd)
set(CPACK_DEBIAN_AGENTD_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/agentd/postinst
    ${PROJECT_SOURCE_DIR}/cmake/agentd/prerm)
set(CPACK_DEBIAN_AGENTD_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-baraka)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "controllers, results and environments of BARAKA in Python
`import baraka`, and `program: my_robot.py` in a scenario. Tables of results as pandas frames, figures
by matplotlib, and scenarios as environments for learning.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "baraka (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")  # results and figures
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/python/postinst
    ${PROJECT_SOURCE_DIR}/cmake/python/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_SDF_PACKAGE_NAME baraka-sdf)
set(CPACK_DEBIAN_SDF_DESCRIPTION "reads robots in URDF and SDF for BARAKA
`baraka-sdf FILE` prints a robot as YAML; with this package, scenarios take `robot: {urdf: FILE}`,
`robot: {sdf: FILE}` and `world: {sdf: FILE}`. In a package of its own for the libraries it needs.")
set(CPACK_DEBIAN_SDF_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SDF_PACKAGE_ENHANCES baraka)

set(CPACK_DEBIAN_DOC_PACKAGE_NAME baraka-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "documentation of BARAKA as a site with a search
Tutorial, how-to pages, reference of files, results and the C++ API, and background, in
/usr/share/doc/baraka-doc/html.")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES LICENSE DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}
    RENAME copyright COMPONENT ${component})
endforeach()

# Read by cpack when it runs: whether there is a site is known only then.
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/without_site.cmake)
set(CPACK_BARAKA_SITE ${site})
include(CPack)
add_custom_target(packages
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${CPACK_OUTPUT_FILE_PREFIX}
  COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${CPACK_OUTPUT_FILE_PREFIX}/_CPack_Packages
  DEPENDS programs WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM)
