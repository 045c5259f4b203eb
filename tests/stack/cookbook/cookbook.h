// SPDX-License-Identifier: Apache-2.0
/// \file cookbook.h
/// Test cases of the recipes of docs/cookbook.md, which main.c runs.
#ifndef LEXICAN_COOKBOOK_H_
#define LEXICAN_COOKBOOK_H_

#ifdef __cplusplus
extern "C" {
#endif

void identity_is_read(void);
void variables_are_read_and_written(void);
void variables_are_used_by_the_application(void);
void a_wrong_table_names_its_entry(void);
void heartbeats_are_produced(void);
void a_missing_heartbeat_is_noticed(void);
void the_master_writes_a_heartbeat_consumer(void);
void a_missing_master_is_noticed(void);
void the_master_makes_the_node_produce_sync(void);
void a_time_message_sets_the_clock(void);
void an_srdo_ends_the_safe_state_and_its_loss_begins_it(void);
void a_gfc_begins_the_safe_state(void);
void an_error_is_raised_and_cleared(void);
void an_error_of_another_node_is_received(void);
void the_master_switches_a_second_server_on(void);
void a_client_reads_and_writes_objects_of_another_node(void);
void a_client_gives_up_a_server_that_is_silent(void);
void an_rpdo_writes_what_it_maps(void);
void a_change_sends_the_tpdo(void);
void the_event_timer_sends_the_tpdo(void);
void the_master_maps_a_tpdo(void);
void the_mapping_of_a_pdo_that_exists_is_refused(void);
void a_multiplex_pdo_names_its_object(void);
void what_was_saved_survives_a_loss_of_power(void);
void a_write_resets_the_date_of_the_configuration(void);
void a_damaged_record_is_reported(void);
void resets_restore_power_on_values(void);
void a_string_is_written_and_read(void);
void a_domain_is_written_in_segments(void);
void a_change_of_the_status_sends_the_tpdo(void);
void error_status_bits_show_each_error(void);
void an_error_of_the_device_stops_the_node(void);
void the_modules_of_a_device_are_read(void);
void the_eds_is_read_from_the_device(void);
void a_command_is_executed_and_answered(void);
void stored_commands_are_executed_later(void);
void the_prompt_echoes_characters(void);
void a_recorder_keeps_the_points_around_its_trigger(void);
void a_client_configures_a_recorder_and_reads_its_plot(void);
void a_user_type_refuses_a_value(void);
void a_user_type_computes_its_value(void);

#ifdef __cplusplus
}
#endif

#endif
