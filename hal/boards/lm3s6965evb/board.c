/* board.c - LM3S6965 evaluation kit: serial port, ticks, OLED */
/* SPDX-License-Identifier: MIT */

#include "board.h"

#include "cpu/ql_cortexm.h"
#include "drivers/ql_bus.h"
#include "drivers/ssd0323.h"

/* Waits for a peripheral give up after this many polls, a second or more. */
#define POLLS_MAX 10000000ul

/* High bits of the tick counter; SysTick itself has 24. */
static volatile uint32_t ticks_high;

void ql_cpu_systick(void)
{
    ticks_high += 0x1000000u;
}

static bool wait_until(uint32_t address, uint32_t mask, uint32_t wanted)
{
    for (uint32_t i = 0; i < POLLS_MAX; i++) {
        if ((QL_REG(address) & mask) == wanted) {
            return true;
        }
    }
    return false;
}

/* 8 MHz crystal, PLL, 200 MHz by 4. */
static bool start_clocks(void)
{
    const uint32_t bypass = 1u << 11, use_divider = 1u << 22;
    uint32_t rcc = QL_REG(SYSCTL_RCC);

    /* Leave the PLL alone while it is set up: run from the oscillator. */
    rcc = (rcc | bypass) & ~use_divider;
    QL_REG(SYSCTL_RCC) = rcc;
    /* Crystal 8 MHz, main oscillator as source and on, PLL on, divider 4. */
    rcc &= ~(0xfu << 6 | 3u << 4 | 1u << 13 | 1u << 0 | 0xfu << 23);
    rcc |= 0xeu << 6 | 3u << 23 | use_divider;
    QL_REG(SYSCTL_RCC) = rcc;
    if (!wait_until(SYSCTL_RIS, 1u << 6, 1u << 6)) {
        return false;
    }
    QL_REG(SYSCTL_RCC) = rcc & ~bypass;
    return true;
}

static void start_serial(void)
{
    /* The divider has six fraction bits: 64 * 50 MHz / (16 * baud), rounded. */
    const uint32_t divider = (QL_PORT_CPU_HZ * 8u / QL_PORT_BAUD + 1u) / 2u;

    QL_REG(UART0 + UART_CTL) = 0;
    QL_REG(UART0 + UART_IBRD) = divider / 64u;
    QL_REG(UART0 + UART_FBRD) = divider % 64u;
    QL_REG(UART0 + UART_LCRH) = 0x70u; /* 8 bits, no parity, FIFO */
    QL_REG(UART0 + UART_CTL) = 0x301u; /* on: receive, transmit */
}

/* 8 bits, clock high when idle, sampled on its second edge. 50 / 14 MHz, as the
 * panel takes 4 MHz at most. */
static void start_panel_bus(void)
{
    QL_REG(SSI0 + SSI_CR1) = 0;
    QL_REG(SSI0 + SSI_CPSR) = 14;
    QL_REG(SSI0 + SSI_CR0) = 0xc7u;
    QL_REG(SSI0 + SSI_CR1) = 2;
}

static void start_pins(void)
{
    QL_REG(SYSCTL_RCGC1) |= 1u << 0 | 1u << 4;
    QL_REG(SYSCTL_RCGC2) |= 1u << 0 | 1u << 2 | 1u << 3;
    (void)QL_REG(SYSCTL_RCGC2); /* clocks take effect three cycles later */
    (void)QL_REG(SYSCTL_RCGC2);
    QL_REG(GPIO_A + GPIO_AFSEL) |= 0x27u; /* 0, 1 UART; 2, 5 SSI */
    QL_REG(GPIO_A + GPIO_DIR) |= 0x08u;
    QL_REG(GPIO_A + GPIO_DEN) |= 0x2fu;
    QL_REG(GPIO_C + GPIO_DIR) |= 0x80u;
    QL_REG(GPIO_C + GPIO_DEN) |= 0x80u;
    QL_REG(GPIO_D + GPIO_DIR) |= 0x01u;
    QL_REG(GPIO_D + GPIO_DEN) |= 0x01u;
    QL_REG(GPIO_D + GPIO_DATA(0x01u)) = 0x01u; /* SD card: not selected */
}

ql_status_t ql_hal_init(void)
{
    const bool clocks = start_clocks();

    start_pins();
    start_serial();
    QL_REG(SYST_RVR) = 0xffffffu;
    QL_REG(SYST_CVR) = 0;
    QL_REG(SYST_CSR) = 7; /* CPU clock, exception, on */
    start_panel_bus();
    return clocks ? ssd0323_init() : QL_ERR_SERIAL;
}

void ql_hal_display_info(ql_hal_display_t *info)
{
    info->width = QL_PORT_PANEL_WIDTH;
    info->height = QL_PORT_PANEL_HEIGHT;
    info->format = QL_PORT_PANEL_FORMAT;
}

ql_status_t ql_hal_display_write(uint16_t y, const uint8_t *pixels)
{
    return ssd0323_write(y, pixels);
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    for (uint16_t i = 0; i < size; i++) {
        if (!wait_until(UART0 + UART_FR, 1u << 5, 0)) {
            return QL_ERR_SERIAL;
        }
        QL_REG(UART0 + UART_DR) = bytes[i];
    }
    return QL_OK;
}

/* SysTick counts down; the exception may come between two of the reads. */
uint32_t ql_hal_ticks(void)
{
    uint32_t high, low;

    do {
        high = ticks_high;
        low = 0xffffffu - QL_REG(SYST_CVR);
    } while (high != ticks_high);
    return high + low;
}

/* Ctrl-C on the serial port. */
bool ql_hal_stop_requested(void)
{
    bool stop = false;

    while ((QL_REG(UART0 + UART_FR) & 1u << 4) == 0) {
        stop = (QL_REG(UART0 + UART_DR) & 0xffu) == 3 || stop;
    }
    return stop;
}

void ql_bus_select(ql_bus_listener_t listener)
{
    /* A bus that stays busy for seconds is reported by the next send. */
    (void)wait_until(SSI0 + SSI_SR, 1u << 4, 0);
    QL_REG(GPIO_A + GPIO_DATA(0x08u)) = listener == QL_BUS_PANEL ? 0 : 0x08u;
}

static bool send(const uint8_t *bytes, uint16_t size, uint32_t data_bit)
{
    /* Data/command must not change before the last byte has left. */
    if (!wait_until(SSI0 + SSI_SR, 1u << 4, 0)) {
        return false;
    }
    QL_REG(GPIO_C + GPIO_DATA(0x80u)) = data_bit;
    for (uint16_t i = 0; i < size; i++) {
        if (!wait_until(SSI0 + SSI_SR, 1u << 1, 1u << 1)) {
            return false;
        }
        QL_REG(SSI0 + SSI_DR) = bytes[i];
        /* What comes back means nothing, but must not fill its queue. */
        while ((QL_REG(SSI0 + SSI_SR) & 1u << 2) != 0) {
            (void)QL_REG(SSI0 + SSI_DR);
        }
    }
    return true;
}

bool ql_bus_command(const uint8_t *bytes, uint16_t size)
{
    return send(bytes, size, 0);
}

bool ql_bus_data(const uint8_t *bytes, uint16_t size)
{
    return send(bytes, size, 0x80u);
}
