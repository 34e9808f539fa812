# Sources merged into few: a whole build then takes two thirds of the time, two fifths without debug information, since the
# headers of ROS and C++ are read once for many sources. One that was changed takes longer to build, so it is off by default.

# Below src: these have a name of their own (a constant, a function without a header) that another source of the same library
# has as well, and are compiled alone. Who gets "redefinition" in a merged build lists the source here, or moves what both need
# into a header. node/wheel_state_publisher.cpp stands in for the one of the library in a test.
set(nord_unmerged
  canopen/compared_write.cpp canopen/node_guard.cpp canopen/pdo_configurator.cpp canopen/sdo_segments.cpp
  catalogue/parameter_text.cpp commissioning/process_values.cpp commissioning/unasked_motion.cpp
  cycle/fault_history.cpp cycle/leaders.cpp cycle/start_acknowledge.cpp cycle/taught_position.cpp
  cycle/user_messages.cpp devicenet/explicit_client.cpp devicenet/io_connection.cpp devicenet/io_fragments.cpp
  node/state_log.cpp node/wheel_state_publisher.cpp profibus/gsd_file.cpp
  profibus/record.cpp profibus/record_channel.cpp profibus/telegram.cpp profile/word_function.cpp
  sim/can/timed_can_bus.cpp sim/canopen/can_pdo_objects.cpp sim/canopen/can_referee.cpp sim/canopen/can_sdo_server.cpp
  sim/canopen/can_stations.cpp sim/canopen/can_tpdo.cpp sim/devicenet/ac_drive.cpp sim/devicenet/dn_config.cpp
  sim/devicenet/dn_io_message.cpp sim/devicenet/dn_layout.cpp sim/devicenet/dn_module_data.cpp
  sim/devicenet/dn_module_objects.cpp sim/devicenet/dn_referee.cpp sim/devicenet/dn_stations.cpp
  sim/interbus/gateway_bus.cpp sim/interbus/ibs_config.cpp sim/interbus/ibs_ring.cpp sim/interbus/pcp_server.cpp
  sim/interbus/register_gateway.cpp sim/interbus/simulated_gateway.cpp sim/inverter/inverter_model.cpp
  sim/inverter/inverter_signals.cpp sim/inverter/posicon.cpp sim/inverter/position_loop.cpp
  sim/inverter/position_words.cpp sim/model_clock.cpp sim/profibus/class2_server.cpp sim/profibus/dp_config.cpp
  sim/profibus/dp_station.cpp sim/profibus/dp_stations.cpp sim/profibus/module_monitoring.cpp
  sim/profibus/module_station.cpp sim/profibus/pty_bus.cpp sim/profibus/record_server.cpp
  sim/profibus/simulated_segment.cpp sim/robot/robot_sim.cpp sim/sim_config.cpp tools/config_check.cpp
  tools/config_json.cpp tools/config_picture.cpp tools/drive_watch.cpp tools/image_command.cpp
  tools/over_ros/node_scan.cpp tools/parameter_dump.cpp tools/parameter_json.cpp tools/progress_bar.cpp
  tools/restore/restore_journal.cpp tools/restore/restore_plan.cpp tools/restore/restore_run.cpp
  tools/scope_record.cpp tools/watch_table.cpp transport/canopen/canopen_eds.cpp transport/devicenet/devicenet.cpp
  transport/devicenet/devicenet_config.cpp transport/devicenet/devicenet_drive.cpp
  transport/devicenet/devicenet_drive_config.cpp transport/devicenet/devicenet_eds.cpp
  transport/devicenet/devicenet_frame_text.cpp transport/devicenet/devicenet_scanner.cpp
  transport/interbus/interbus_parameters.cpp transport/interbus/pcp_config.cpp transport/profibus/ppo.cpp
  transport/profibus/profibus_dp_config.cpp transport/profibus/profibus_parameters.cpp
  transport/profibus/profibus_scanner.cpp transport/profibus/profibus_stations.cpp)

# To be called where `target` is made: a property of a source is known to the targets of its folder only.
function(nord_merge_sources target)
  if(NORD_DRIVER_MERGE_SOURCES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    foreach(source ${nord_unmerged})
      set_source_files_properties(${PROJECT_SOURCE_DIR}/src/${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endforeach()
  endif()
endfunction()
