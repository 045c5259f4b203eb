// SPDX-License-Identifier: Apache-2.0
// Runs the recipes of docs/cookbook.md.
#include "cookbook.h"
#include "unity.h"

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(identity_is_read);
  RUN_TEST(variables_are_read_and_written);
  RUN_TEST(variables_are_used_by_the_application);
  RUN_TEST(a_wrong_table_names_its_entry);
  RUN_TEST(heartbeats_are_produced);
  RUN_TEST(a_missing_heartbeat_is_noticed);
  RUN_TEST(the_master_writes_a_heartbeat_consumer);
  RUN_TEST(a_missing_master_is_noticed);
  RUN_TEST(the_master_makes_the_node_produce_sync);
  RUN_TEST(a_time_message_sets_the_clock);
  RUN_TEST(an_srdo_ends_the_safe_state_and_its_loss_begins_it);
  RUN_TEST(a_gfc_begins_the_safe_state);
  RUN_TEST(an_error_is_raised_and_cleared);
  RUN_TEST(an_error_of_another_node_is_received);
  RUN_TEST(the_master_switches_a_second_server_on);
  RUN_TEST(a_client_reads_and_writes_objects_of_another_node);
  RUN_TEST(a_client_gives_up_a_server_that_is_silent);
  RUN_TEST(an_rpdo_writes_what_it_maps);
  RUN_TEST(a_change_sends_the_tpdo);
  RUN_TEST(the_event_timer_sends_the_tpdo);
  RUN_TEST(the_master_maps_a_tpdo);
  RUN_TEST(the_mapping_of_a_pdo_that_exists_is_refused);
  RUN_TEST(a_multiplex_pdo_names_its_object);
  RUN_TEST(what_was_saved_survives_a_loss_of_power);
  RUN_TEST(a_write_resets_the_date_of_the_configuration);
  RUN_TEST(a_damaged_record_is_reported);
  RUN_TEST(resets_restore_power_on_values);
  RUN_TEST(a_string_is_written_and_read);
  RUN_TEST(a_domain_is_written_in_segments);
  RUN_TEST(a_change_of_the_status_sends_the_tpdo);
  RUN_TEST(error_status_bits_show_each_error);
  RUN_TEST(an_error_of_the_device_stops_the_node);
  RUN_TEST(the_modules_of_a_device_are_read);
  RUN_TEST(the_eds_is_read_from_the_device);
  RUN_TEST(a_command_is_executed_and_answered);
  RUN_TEST(stored_commands_are_executed_later);
  RUN_TEST(the_prompt_echoes_characters);
  RUN_TEST(a_recorder_keeps_the_points_around_its_trigger);
  RUN_TEST(a_client_configures_a_recorder_and_reads_its_plot);
  RUN_TEST(a_user_type_refuses_a_value);
  RUN_TEST(a_user_type_computes_its_value);
  return UNITY_END();
}
