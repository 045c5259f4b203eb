// SPDX-License-Identifier: Apache-2.0
// Start-up code of a Cortex-A53 at EL3, EL2 or EL1, without MMU. Memory is then Device memory, where accesses must be
// aligned; the alignment check detects others. Interrupts do not nest.
    .section .text.start, "ax"
    .global start
start:
    ldr x0, =stack_top
    mov sp, x0
    ldr x1, =vectors
    mrs x2, CurrentEL
    cmp x2, #(3 << 2)
    b.ne 1f
    msr vbar_el3, x1
    msr cntvoff_el2, xzr
    mrs x0, scr_el3
    orr x0, x0, #(1 << 1)       // interrupts to EL3
    msr scr_el3, x0
    mrs x0, sctlr_el3
    orr x0, x0, #(1 << 1)       // alignment check
    msr sctlr_el3, x0
    b 3f
1:  cmp x2, #(2 << 2)
    b.ne 2f
    msr vbar_el2, x1
    msr cntvoff_el2, xzr
    mrs x0, hcr_el2
    orr x0, x0, #(1 << 4)       // interrupts to EL2
    msr hcr_el2, x0
    mrs x0, sctlr_el2
    orr x0, x0, #(1 << 1)
    msr sctlr_el2, x0
    b 3f
2:  msr vbar_el1, x1
    mrs x0, sctlr_el1
    orr x0, x0, #(1 << 1)
    msr sctlr_el1, x0
3:  isb
    ldr x0, =bss_begin
    ldr x1, =bss_end
4:  cmp x0, x1
    b.hs 5f
    str xzr, [x0], #8
    b 4b
5:  bl main
    b leave_machine

    // void leave_machine(uint32_t status): SYS_EXIT
    .global leave_machine
leave_machine:
    mov w0, w0
    sub sp, sp, #16
    mov x1, #0x0026             // ADP_Stopped_ApplicationExit
    movk x1, #2, lsl #16
    stp x1, x0, [sp]
    mov x1, sp
    mov w0, #0x18
    hlt #0xF000
6:  b 6b

    // uint64_t ask_host(uint64_t operation, const void* argument)
    .global ask_host
ask_host:
    hlt #0xF000
    ret

interrupt:
    stp x0, x1, [sp, #-176]!
    stp x2, x3, [sp, #16]
    stp x4, x5, [sp, #32]
    stp x6, x7, [sp, #48]
    stp x8, x9, [sp, #64]
    stp x10, x11, [sp, #80]
    stp x12, x13, [sp, #96]
    stp x14, x15, [sp, #112]
    stp x16, x17, [sp, #128]
    stp x18, x30, [sp, #144]
    bl serve_interrupt
    ldp x2, x3, [sp, #16]
    ldp x4, x5, [sp, #32]
    ldp x6, x7, [sp, #48]
    ldp x8, x9, [sp, #64]
    ldp x10, x11, [sp, #80]
    ldp x12, x13, [sp, #96]
    ldp x14, x15, [sp, #112]
    ldp x16, x17, [sp, #128]
    ldp x18, x30, [sp, #144]
    ldp x0, x1, [sp], #176
    eret

fault:
    mov w0, #99
    b leave_machine

    .macro vector to
    .balign 128
    b \to
    .endm

    .balign 2048
vectors:
    vector fault                // with SP0
    vector interrupt
    vector fault
    vector fault
    vector fault                // with the stack of this level
    vector interrupt
    vector fault
    vector fault
    .rept 8                     // from lower levels
    vector fault
    .endr
