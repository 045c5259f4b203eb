// SPDX-License-Identifier: Apache-2.0
/// \file example_cpu.h
/// CPU instructions that the example uses: instructions on Cortex-M, functions of a simulation elsewhere.
#ifndef EXAMPLE_CPU_H_
#define EXAMPLE_CPU_H_

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__arm__)
static inline void CpuDisableInterrupts(void) { __asm volatile("cpsid i" ::: "memory"); }
static inline void CpuEnableInterrupts(void) { __asm volatile("cpsie i" ::: "memory"); }
static inline void CpuWaitForInterrupt(void) { __asm volatile("dsb\n wfi" ::: "memory"); }
#else
void CpuDisableInterrupts(void);
void CpuEnableInterrupts(void);
void CpuWaitForInterrupt(void);  ///< returns when an interrupt is pending, also where interrupts are disabled
#endif

#ifdef __cplusplus
}
#endif

#endif
