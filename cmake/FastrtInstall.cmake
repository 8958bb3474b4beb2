# cmake --install: the program, the library with its headers, and what find_package(fastrt) needs.
include(CMakePackageConfigHelpers)

set(fastrt_config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/fastrt)

install(TARGETS fastrt_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS fastrt fastrt_public EXPORT fastrtTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/fastrt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# src/modules installs its modules.
install(EXPORT fastrtTargets NAMESPACE fastrt:: DESTINATION ${fastrt_config_folder})

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/fastrtConfig.cmake.in ${PROJECT_BINARY_DIR}/fastrtConfig.cmake
  INSTALL_DESTINATION ${fastrt_config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fastrtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fastrtConfig.cmake ${PROJECT_BINARY_DIR}/fastrtConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/module_folder.cpp
  DESTINATION ${fastrt_config_folder})
