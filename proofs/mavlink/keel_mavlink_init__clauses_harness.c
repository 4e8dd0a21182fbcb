// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282
// sources: src/middleware/mavlink.c src/middleware/crc.c
// checks: assertions
// covers: keel_mavlink_init is_table
//
// Each clause of the contract, without the model: any table, and any number of messages, those that
// are too large included. All other checks: keel_mavlink_init_harness.c.
#include "mavlink_contracts.h"

/* mavlink_table: of each message, its id is above those of all messages before it. */
static bool table_here(const keel_mavlink_message_t *messages, uint32_t known)
{
    bool right = true;
    uint32_t above = 0u; /* One more than the largest id so far. */

    for (uint32_t i = 0u; i < KEEL_MAVLINK_MESSAGES_MAX; i++) {
        const keel_mavlink_message_t *const message = &messages[i];

        right = right && ((i >= known) ||
                          ((message->id <= 0xFFFFFFu) && (message->shortest <= message->longest) &&
                           (above <= message->id)));
        above = (message->id >= above) ? (message->id + 1u) : above;
    }
    return right;
}

void keel_mavlink_init__clauses_harness(void)
{
    keel_mavlink_t mavlink = any_mavlink();
    const uint32_t known = nondet_u32();
    const bool full = known > KEEL_MAVLINK_MESSAGES_MAX;
    const bool right = table_here(table.messages, known);
    const bool made = !full && right;
    keel_status_t status;

    status = keel_mavlink_init(&mavlink, table.messages, known);

    __CPROVER_assert(!full || (status == KEEL_ERR_FULL),
                     "MAV_001_full: more messages than fit are refused");
    __CPROVER_assert(full || right || (status == KEEL_ERR_LIMITS),
                     "MAV_001_table: so is a table that is not right");
    __CPROVER_assert(!made || ((status == KEEL_OK) && (mavlink.held == 0u) &&
                               (mavlink.awaited == KEEL_MAVLINK_HEADER_BYTES)),
                     "MAV_002_made: any other one is taken, and a header is awaited");
    __CPROVER_assert(!made || mavlink_valid_here(&mavlink), "MAV_002_made: the decoder is valid");
    __CPROVER_assert(!made || ((mavlink.known <= KEEL_MAVLINK_MESSAGES_MAX) &&
                               table_here(mavlink.messages, mavlink.known)),
                     "MAV_002_made: its table is right");
    __CPROVER_assert(!made || ((mavlink.messages == table.messages) && (mavlink.known == known)),
                     "MAV_002_messages: it knows these messages");
    __CPROVER_assert(!made || ((mavlink.count.frames == 0u) && (mavlink.frame.length == 0u)),
                     "MAV_002_none: no frame was there yet");
}
