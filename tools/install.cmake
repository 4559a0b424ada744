# What `cmake --install` gives: the command, the shipped scenes, and a CMake package with the
# targets lumivec::loader and lumivec::integrator for other renderers.
include(CMakePackageConfigHelpers)

set(lumivec_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lumivec)

# The interface; the other headers of these folders belong to the libraries' insides.
install(FILES loader/animate.h loader/error.h loader/load_scene.h loader/scene.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lumivec/loader)
install(FILES
  integrator/check_settings.h integrator/framebuffer.h integrator/render.h integrator/settings.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lumivec/integrator)

install(TARGETS lumivec DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS lumivec_loader lumivec_integrator EXPORT lumivec_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lumivec_targets NAMESPACE lumivec:: FILE lumivecTargets.cmake
  DESTINATION ${lumivec_package_dir})

string(REGEX MATCH "^[0-9]+" lumivec_embree_major "${embree_VERSION}")
configure_package_config_file(tools/lumivecConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lumivecConfig.cmake
  INSTALL_DESTINATION ${lumivec_package_dir}
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lumivecConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/lumivecConfig.cmake
  ${PROJECT_BINARY_DIR}/lumivecConfigVersion.cmake
  DESTINATION ${lumivec_package_dir})

install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/lumivec
  FILES_MATCHING PATTERN *.gltf PATTERN *.bin PATTERN *.hdr PATTERN textures/*.png
  PATTERN pictures EXCLUDE)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
