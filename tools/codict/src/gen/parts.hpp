// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// Steps of make_plan(), in the order in which it calls them; each uses the results of the steps before it.
#pragma once

#include "gen/plan.hpp"

namespace lexican::codict::gen {

// Flags of CO_KEY().
constexpr std::uint32_t flag_write = 0x01;
constexpr std::uint32_t flag_read = 0x02;
constexpr std::uint32_t flag_pdo = 0x04;
constexpr std::uint32_t flag_trigger = 0x08;
constexpr std::uint32_t flag_node_id = 0x40;
constexpr std::uint32_t flag_direct = 0x80;

void plan_items(const Device& device, const Options& options, Plan& plan, Findings& findings);
void plan_srdos(Plan& plan, Findings& findings);
void plan_names(const Options& options, Plan& plan, Findings& findings);
void plan_groups(const Options& options, Plan& plan, Findings& findings);
void plan_limited_types(Plan& plan);
void plan_pdos(Plan& plan, Findings& findings);

}  // namespace lexican::codict::gen
