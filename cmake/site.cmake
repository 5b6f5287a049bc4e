# The target `docs`: the site of docs/ with a search, and the reference of the headers that a controller includes, in
# <build>/site. It takes mkdocs-material and doxygen and no network. On request only, as the pages of the browser.
set(site ${PROJECT_BINARY_DIR}/site)
set(site_build ${PROJECT_BINARY_DIR}/site_build)  # what mkdocs reads: a copy of docs and the reference in its folder api
set(site_source ${PROJECT_SOURCE_DIR}/cmake/site)
configure_file(${site_source}/Doxyfile.in ${site_build}/Doxyfile @ONLY)
configure_file(${site_source}/Doxyfile.check.in ${site_build}/Doxyfile.check @ONLY)
add_custom_target(docs
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${site} docs doxygen
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/docs docs
  COMMAND ${CMAKE_COMMAND} -E copy ${site_source}/mkdocs.yml ${site_source}/hooks.py .
  COMMAND doxygen Doxyfile.check
  COMMAND doxygen Doxyfile
  COMMAND ${CMAKE_COMMAND} -E copy_directory doxygen/api docs/api
  COMMAND mkdocs build --quiet --strict
  COMMAND ${CMAKE_COMMAND} -E rm -f ${site}/404.html ${site}/sitemap.xml ${site}/sitemap.xml.gz  # of a server
  COMMAND ${CMAKE_COMMAND} -E echo "the site is in ${site}"
  WORKING_DIRECTORY ${site_build} VERBATIM)
