/* ssd0323.h - the SSD0323 panel controller: 128x64 pixels of 4 bits */
/* SPDX-License-Identifier: MIT */

#ifndef SSD0323_H
#define SSD0323_H

#include "base/ql_base.h"

#define SSD0323_WIDTH  128u
#define SSD0323_HEIGHT 64u

/* Switch the panel on. Its memory holds noise until every row is written.
 *
 *   return  QL_OK or QL_ERR_DISPLAY
 */
QL_MUST_CHECK ql_status_t ssd0323_init(void);

/* Write one row.
 *
 *   row     px  0..63 from the top
 *   pixels  -   64 bytes, QL_FORMAT_GRAY4
 *   return  QL_OK or QL_ERR_DISPLAY
 */
QL_MUST_CHECK ql_status_t ssd0323_write(uint16_t row, const uint8_t *pixels);

#endif
