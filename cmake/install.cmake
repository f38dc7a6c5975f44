# `cmake --install`: headers by room under include/lahar, libraries, executables, scenes, and what find_package(Lahar)
# needs to give Lahar::core, Lahar::lbm, Lahar::dem, Lahar::barrier and Lahar::coupling.
include(CMakePackageConfigHelpers)

set(lahar_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Lahar)

set(lahar_exported lahar_options)
foreach(room core lbm dem barrier coupling)
  if(TARGET lahar_${room})
    list(APPEND lahar_exported lahar_${room})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lahar
            FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
install(TARGETS ${lahar_exported} EXPORT LaharTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT LaharTargets NAMESPACE Lahar:: DESTINATION ${lahar_config_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/LaharConfig.cmake.in ${PROJECT_BINARY_DIR}/LaharConfig.cmake
                              INSTALL_DESTINATION ${lahar_config_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/LaharConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/LaharConfig.cmake ${PROJECT_BINARY_DIR}/LaharConfigVersion.cmake
        DESTINATION ${lahar_config_dir})

# Every executable under cases/ is installed under its own name.
function(lahar_install_executables directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory ${subdirectories})
    lahar_install_executables(${subdirectory})
  endforeach()
endfunction()
lahar_install_executables(${PROJECT_SOURCE_DIR}/cases)

# Scenes with their pages and reference data.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases DESTINATION ${CMAKE_INSTALL_DATADIR}/lahar
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "README.md")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
