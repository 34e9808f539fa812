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

# Below test/, for the same reason.
set(nord_unmerged_tests
  campaign/answer_invariants.cpp campaign/canopen_rig.cpp campaign/devicenet_rig.cpp campaign/following_invariants.cpp
  campaign/motion_invariants.cpp campaign/player_sight.cpp campaign/position_invariants.cpp campaign/test_campaign.cpp
  canopen/test_full_queue.cpp catalogue/test_catalogues.cpp commissioning/test_bus_selection.cpp
  config/test_driver_settings.cpp config/test_eeprom_settings.cpp config/test_setting_checks.cpp
  config/test_text_file.cpp config/test_yaml_merge.cpp cycle/test_asked_bits.cpp cycle/test_base_config.cpp
  cycle/test_base_minimum.cpp cycle/test_base_motion.cpp cycle/test_base_ramps.cpp cycle/test_base_values.cpp
  cycle/test_cycle_config.cpp cycle/test_cycle_picture.cpp cycle/test_device_reader.cpp cycle/test_drive_words.cpp
  cycle/test_forward_only_steps.cpp cycle/test_further_setpoints.cpp cycle/test_joint_limits.cpp
  cycle/test_make_drives.cpp cycle/test_module_parameters.cpp cycle/test_monitor_reader.cpp cycle/test_read_again.cpp
  cycle/test_standstill_jobs.cpp cycle/test_start_acknowledge.cpp cycle/test_steered_motion.cpp cycle/test_steered_reversal.cpp
  cycle/test_word_needs.cpp cycle/test_word_setup.cpp devicenet/test_process_data.cpp
  documents/test_catalogue_tables.cpp drive/test_eeprom_switch.cpp drive/test_element_target.cpp
  drive/test_geared_axis.cpp drive/test_homing_run.cpp drive/test_parameter_read_ahead.cpp
  drive/test_position_drive.cpp drive/test_position_increment.cpp drive/test_position_reader.cpp
  drive/test_reset_run.cpp explore/test_class2_events.cpp explore/test_drive_events.cpp
  explore/test_explicit_channel_events.cpp explore/test_explicit_client_events.cpp explore/test_pkw_events.cpp
  explore/test_record_events.cpp explore/test_sdo_events.cpp explore/test_supervisor_events.cpp
  link/can/test_can_settings.cpp link/modbus/test_refused_parts.cpp link/test_no_allocation.cpp
  node/test_bus_sentence.cpp node/test_drive_protection.cpp node/test_node_config.cpp
  profibus/test_fault_sequences.cpp profibus/test_gsd_file.cpp profibus/test_identification.cpp
  profibus/test_left_running.cpp profibus/test_listen_first.cpp profibus/test_saved_watchdog.cpp
  profile/test_ac_drive.cpp profile/test_cia402.cpp profile/test_pkw_channel.cpp robot/test_diff_drive_kinematics.cpp
  robot/test_mecanum_kinematics.cpp robot/test_odometry.cpp robot/test_speed_limiter.cpp robot/test_twist_limiter.cpp
  robot/test_urdf_geometry.cpp rules/build_rules.cpp rules/dependency_rules.cpp rules/test_document_rules.cpp
  sim/canopen/test_can_config.cpp sim/canopen/test_can_gateway.cpp sim/canopen/test_can_node.cpp
  sim/canopen/test_can_pdo.cpp sim/canopen/test_can_positions.cpp sim/canopen/test_can_sdo.cpp
  sim/canopen/test_cia402_node.cpp sim/devicenet/test_dn_change_connections.cpp sim/devicenet/test_dn_config.cpp
  sim/devicenet/test_dn_positions.cpp sim/interbus/test_pcp_server.cpp sim/inverter/test_posicon.cpp
  sim/profibus/test_module_timeouts.cpp state/test_budget_of_processes.cpp system/stop_rows.cpp
  system/test_canopen_causes.cpp system/test_canopen_clean_exit.cpp system/test_canopen_double_id.cpp
  system/test_canopen_found_driven.cpp system/test_canopen_four_inverters.cpp system/test_canopen_parameters_only.cpp
  system/test_canopen_silent_node.cpp system/test_canopen_slow_queue.cpp system/test_canopen_two_masters.cpp
  system/test_canopen_unasked_state.cpp system/test_causes_at_a_drive.cpp system/test_codes_told_profibus.cpp
  system/test_devicenet_driving.cpp system/test_devicenet_fault_sequences.cpp system/test_devicenet_found_faults.cpp
  system/test_devicenet_protection.cpp system/test_devicenet_slow_queue.cpp system/test_devicenet_two_scanners.cpp
  system/test_element_targets.cpp system/test_fault_sequences.cpp system/test_following.cpp
  system/test_four_inverters.cpp system/test_gateway_network.cpp system/test_interbus_driving.cpp
  system/test_interbus_found_faults.cpp system/test_interbus_network.cpp system/test_interbus_services.cpp
  system/test_interbus_watchdog.cpp system/test_lost_telegrams.cpp system/test_no_allocation.cpp
  system/test_no_allocation_interbus.cpp system/test_node_ends.cpp system/test_parameter_errors.cpp
  system/test_real_time.cpp system/test_reset_position.cpp system/test_soak.cpp system/test_steered_base.cpp
  system/test_steered_homing.cpp system/test_steered_stops.cpp system/test_what_stops_what.cpp
  tools/restore/test_restore_plan.cpp tools/test_comparison.cpp tools/test_monitored_parameters.cpp
  tools/test_parameter_dump.cpp tools/test_parameter_name.cpp tools/test_scope_record.cpp trace/test_fault_tracer.cpp
  transport/canopen/test_canopen.cpp transport/canopen/test_canopen_bus_events.cpp
  transport/canopen/test_canopen_config.cpp transport/canopen/test_canopen_eds.cpp
  transport/canopen/test_canopen_frame_text.cpp transport/canopen/test_canopen_listening.cpp
  transport/canopen/test_canopen_parameters.cpp transport/canopen/test_canopen_scanner.cpp
  transport/canopen/test_module_link.cpp transport/devicenet/test_devicenet.cpp
  transport/devicenet/test_devicenet_config.cpp transport/devicenet/test_devicenet_frame_text.cpp
  transport/devicenet/test_devicenet_listening.cpp transport/devicenet/test_devicenet_losses.cpp
  transport/devicenet/test_devicenet_parameters.cpp transport/devicenet/test_devicenet_scanner.cpp
  transport/devicenet/test_found_faults.cpp transport/devicenet/test_state_probe.cpp
  transport/interbus/test_interbus.cpp transport/interbus/test_interbus_parameters.cpp
  transport/interbus/test_pcp_connection.cpp transport/interbus/test_simulated_gateway.cpp
  transport/profibus/test_inverter_presence.cpp transport/profibus/test_profibus_departures.cpp
  transport/profibus/test_profibus_dp.cpp transport/profibus/test_profibus_gives_way.cpp
  transport/profibus/test_profibus_module.cpp transport/profibus/test_profibus_recorder.cpp)

# Sources of `folder` (src, test), `batch` at a time, but those that follow. To be called where `target` is made: a property of a
# source is known to the targets of its folder only.
function(nord_merge target folder batch)
  if(NORD_DRIVER_MERGE_SOURCES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    foreach(source ${ARGN})
      set_source_files_properties(${PROJECT_SOURCE_DIR}/${folder}/${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endforeach()
  endif()
endfunction()

function(nord_merge_sources target)
  nord_merge(${target} src 12 ${nord_unmerged})
endfunction()

# A program of unit tests.
function(nord_merge_tests target)
  nord_merge(${target} test 8 ${nord_unmerged_tests})
endfunction()
