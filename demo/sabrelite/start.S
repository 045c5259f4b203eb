// SPDX-License-Identifier: Apache-2.0
// Start-up code of a Cortex-A9 in supervisor mode, without MMU and caches. Interrupts do not nest.
    .syntax unified
    .cpu cortex-a9
    .arm
    .section .text.start, "ax"
    .global start
start:
    cpsid if
    ldr r0, =vectors
    mcr p15, 0, r0, c12, c0, 0  // VBAR
    cps #0x12                   // mode of interrupts
    ldr sp, =interrupt_stack_top
    cps #0x13                   // supervisor mode
    ldr sp, =stack_top
    ldr r0, =bss_begin
    ldr r1, =bss_end
    mov r2, #0
1:  cmp r0, r1
    strlo r2, [r0], #4
    blo 1b
    bl main
    // SYS_EXIT_EXTENDED of semihosting
    .global LeaveMachine
LeaveMachine:
    ldr r1, =0x20026            // ADP_Stopped_ApplicationExit
    push {r0}
    push {r1}
    mov r1, sp
    mov r0, #0x20
    svc #0x123456
2:  b 2b

    // uint32_t AskHost(uint32_t operation, const void* argument)
    .global AskHost
AskHost:
    push {r4, lr}
    svc #0x123456
    pop {r4, pc}

interrupt:
    sub lr, lr, #4
    push {r0-r3, r12, lr}
    bl BoardInterrupt
    ldm sp!, {r0-r3, r12, pc}^

fault:
    cps #0x13
    ldr sp, =stack_top
    mov r0, #99
    b LeaveMachine

    .balign 32
vectors:
    b start
    b fault
    b fault                     // semihosting calls do not arrive here
    b fault
    b fault
    b fault
    b interrupt
    b fault
