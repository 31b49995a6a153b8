# Tests of ui/models and ui/panels, one program each; they need no screen.
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Gui Widgets Test)

foreach(name models panels_parameter_form panels_tables panels_stage_times panels_messages panels_inspector panels_chip_grid)
    set(target ui_${name}_test)
    add_executable(${target} ${CMAKE_CURRENT_LIST_DIR}/${name}_test.cpp)
    set_target_properties(${target} PROPERTIES AUTOMOC ON)
    target_link_libraries(${target} PRIVATE eyrie_warnings eyrie_ui_panels Qt6::Test)
    add_test(NAME ui_${name} COMMAND ${target})
    set_tests_properties(ui_${name} PROPERTIES TIMEOUT 60 ENVIRONMENT QT_QPA_PLATFORM=offscreen)
endforeach()
