// SPDX-License-Identifier: Apache-2.0
/// \file cases.hpp
/// Tables of cases, one for each source file.
#pragma once

#include "check.hpp"

namespace zynqmp {

Cases nmt_cases();
Cases sdo_cases();
Cases pdo_cases();
Cases emcy_cases();
Cases master_cases();
Cases driver_cases();

}  // namespace zynqmp
