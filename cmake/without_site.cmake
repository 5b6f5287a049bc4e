# For cpack: no package baraka-doc where ./setup docs has not built the site.
if(NOT EXISTS ${CPACK_BARAKA_SITE}/index.html)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL doc)
endif()
