/* fault_main.c - a main() that goes wrong in one of four ways */
/* SPDX-License-Identifier: MIT */

/* Built in place of hal/ql_main.c; TEST_FAULT says how. The stream's header
 * goes out first, so that the report is found between frames. The instruction
 * that is none is in main() itself, where little of the stack is used. */

#include "board.h"
#include "app/ql_app.h"

int main(void);
uint8_t fall(volatile uint8_t *above);

/* Without an end, as far as the compiler cannot know, and with something on the
 * stack each time. */
QL_NOINLINE uint8_t fall(volatile uint8_t *above)
{
    static volatile bool enough;
    volatile uint8_t here[64];

    here[0] = (uint8_t)(*above + 1u);
    return enough ? *above : (uint8_t)(fall(here) + here[0]);
}

int main(void)
{
    static uint8_t frame[QL_STREAM_FRAME_BYTES(QL_STREAM_HEAD_BYTES)];
    const ql_settings_t settings = {
            .width = 1, .height = 1, .spp = 1, .light_samples = 1};
    volatile uint8_t zero = 0;

    if (ql_hal_init() != QL_OK ||
            ql_hal_serial_write(frame, ql_stream_head(frame, &settings,
                                               QL_FORMAT_RGB888)) != QL_OK) {
        return 0;
    }
#if TEST_FAULT == 0
    ql_hal_panic(7, 123);
#elif TEST_FAULT == 1
    zero = fall(&zero);
#elif TEST_FAULT == 2 && defined(__riscv)
    /* undefined for good */
    __asm__ volatile(".global fault_here\nfault_here: .short 0");
#elif TEST_FAULT == 2
    __asm__ volatile(".global fault_here\nfault_here: .short 0xde00");
#else
    ql_hal_exit(QL_ERR_STOPPED);
#endif
    return zero;
}
