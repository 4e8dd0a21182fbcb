/* SPDX-License-Identifier: Apache-2.0 */
/* SDMMC1 (RM0410, chapter 39), and an SD card of high capacity in its slot: commands, states and
 * status of the SD Physical Layer Simplified Specification (4.7.4, 4.8 and 4.10.1). Commands and
 * data take the time that the bus needs; the processor moves the data through the FIFO. */
#include "model.h"

#include "stm32f767/registers/rcc.h"
#include "stm32f767/registers/sdmmc.h"

#include <stddef.h>
#include <string.h>

#define SECTOR         512u
#define SECTORS_A_UNIT 1024u /* Of C_SIZE. */
#define WORD           4u
#define FIFO_BYTES     128u
#define HALF           32u /* Bytes of the 8 words that TXFIFOHE and RXFIFOHF are about. */

#define KERNEL_HZ     48000000u
#define IDENTIFY_HZ   400000u
#define TRANSFER_HZ   25000000u
#define DIVISOR_ADD   2u
#define COMMAND_BITS  48u
#define SHORT_BITS    56u /* An answer of 48, 8 clocks behind the command. */
#define LONG_BITS     144u
#define PATIENCE_BITS 64u /* The answer's time-out. */
#define STATUS_BITS   16u /* A block's checksum, and what the card says of it. */
#define BYTE_BITS     8u
#define FOUR_LINES    1u
#define POWER_ON      3u
#define SECTOR_CODE   9u
#define SHORT_ANSWER  1u
#define LONG_ANSWER   3u

#define PROGRAM_US  2000u /* For which the card is busy behind a write. */
#define ACCESS_US   200u  /* Until it sends the first block. */
#define READY_AFTER 2u    /* Questions. */

#define CONDITIONS      0x00FF8000u /* 2.7 to 3.6 V, … */
#define CONDITIONS_HIGH 0x40000000u /* … high capacity, … */
#define CONDITIONS_UP   0x80000000u /* … and ready. */
#define ADDRESS         0xB3680000u
#define IS_APPLICATION  0x20u
#define IS_READY        0x100u
#define IS_ILLEGAL      0x00400000u
#define IS_OUT_OF_RANGE 0x80000000u
#define STATE_AT        9u
#define NO_ANSWER       0u

#define COMMAND_FLAGS                                                                              \
    (SDMMC_STA_CCRCFAIL | SDMMC_STA_CTIMEOUT | SDMMC_STA_CMDREND | SDMMC_STA_CMDSENT)

#define CARD_FUNCTION 12u
#define POWER_PORT    6u
#define POWER_PIN     7u

typedef enum card_state {
    IDLE,
    READY,
    IDENTIFIED,
    STANDBY,
    TRANSFER,
    SENDING,
    RECEIVING,
    PROGRAMMING
} card_state_t;

/* What the card is, and what it does now. */
typedef struct model_card {
    uint8_t *bytes; /* Null: the slot is empty. */
    uint32_t sectors;
    bool is_out;
    bool is_stuck; /* What it programs does not come to an end. */
    card_state_t state;
    uint32_t address;
    uint32_t errors;
    bool is_wide;
    bool is_announced; /* The next command is an application's. */
    uint32_t questions;
    uint32_t at; /* The sector that comes next. */
    bool is_single;
    uint64_t ready_at;
} model_card_t;

/* What SDMMC1 does. */
typedef struct model_slot {
    uint32_t flags;
    uint32_t answers; /* Flags that come, … */
    uint64_t answered_at;
    uint64_t begun; /* The first byte of the data moves. */
    uint64_t gives_up_at;
    bool moves;      /* Data move. */
    uint32_t length; /* Bytes of a transfer, … */
    uint32_t passed; /* … and how many went through the FIFO's side of the processor. */
    uint32_t stored; /* Blocks that the card has. */
    uint8_t ring[2u * SECTOR];
} model_slot_t;

/* What a command answers: its words, as many as are told. */
typedef struct card_answer {
    uint32_t count;
    uint32_t word[4];
} card_answer_t;

static model_card_t card;
static model_slot_t slot;

static uint32_t slot_word(uint32_t offset)
{
    return *model_word(SDMMC1_BASE + offset);
}

/* --- The card. --- */

static void power_card(void)
{
    card.state = IDLE;
    card.address = 0u;
    card.errors = 0u;
    card.is_wide = false;
    card.is_announced = false;
    card.questions = 0u;
}

static bool is_card_there(void)
{
    return (card.bytes != NULL) && !card.is_out;
}

/* A card that has programmed is ready again. */
static void end_programming(void)
{
    if ((card.state == PROGRAMMING) && !card.is_stuck && (model_now() >= card.ready_at)) {
        card.state = TRANSFER;
    }
}

static void program(void)
{
    card.state = PROGRAMMING;
    card.ready_at = model_now() + ((uint64_t)PROGRAM_US * MODEL_TICKS_PER_US);
}

static card_answer_t answer_of(uint32_t word)
{
    return (card_answer_t){1u, {word}};
}

static card_answer_t answer_status(void)
{
    const uint32_t status = card.errors | ((uint32_t)card.state << STATE_AT) |
                            ((card.state == TRANSFER) ? IS_READY : 0u);

    card.errors = 0u;
    return answer_of(status);
}

static card_answer_t refuse(void)
{
    card.errors |= IS_ILLEGAL;
    return (card_answer_t){NO_ANSWER, {0u}};
}

/* The answer tells the state that it comes from. */
static card_answer_t move_card(card_state_t from, card_state_t to)
{
    card_answer_t answer;

    if (card.state != from) {
        return refuse();
    }
    answer = answer_status();
    card.state = to;
    return answer;
}

static card_answer_t go_idle(uint32_t argument)
{
    (void)argument;
    power_card();
    return (card_answer_t){NO_ANSWER, {0u}};
}

static card_answer_t tell_identity(uint32_t argument)
{
    (void)argument;
    if (card.state != READY) {
        return refuse();
    }
    card.state = IDENTIFIED;
    return (card_answer_t){4u, {0x03534453u, 0x4C303847u, 0x80123456u, 0x78012300u}};
}

static card_answer_t tell_address(uint32_t argument)
{
    (void)argument;
    if (card.state != IDENTIFIED) {
        return refuse();
    }
    card.state = STANDBY;
    card.address = ADDRESS;
    return answer_of(ADDRESS);
}

static card_answer_t select_card(uint32_t argument)
{
    (void)argument;
    return move_card(STANDBY, TRANSFER);
}

static card_answer_t tell_condition(uint32_t argument)
{
    return (card.state == IDLE) ? answer_of(argument & 0xFFFu) : refuse();
}

static card_answer_t tell_data(uint32_t argument)
{
    const uint32_t size = (card.sectors / SECTORS_A_UNIT) - 1u;

    (void)argument;
    if (card.state != STANDBY) {
        return refuse();
    }
    return (card_answer_t){
        4u, {0x400E0032u, 0x5B590000u | (size >> 16u), (size << 16u) | 0x7F80u, 0x0A400000u}};
}

static card_answer_t stop_transfer(uint32_t argument)
{
    card_answer_t answer;

    (void)argument;
    if (card.state != RECEIVING) {
        return move_card(SENDING, TRANSFER);
    }
    answer = answer_status();
    program();
    return answer;
}

static card_answer_t tell_status(uint32_t argument)
{
    (void)argument;
    return (card.state < STANDBY) ? refuse() : answer_status();
}

static card_answer_t announce(uint32_t argument)
{
    card_answer_t answer = answer_status();

    (void)argument;
    card.is_announced = true;
    answer.word[0] |= IS_APPLICATION;
    return answer;
}

/* ACMD41: a host that does not say that it knows high capacity waits for ever. */
static card_answer_t tell_ready(uint32_t argument)
{
    if (card.state != IDLE) {
        return refuse();
    }
    card.questions++;
    if (((argument & CONDITIONS_HIGH) == 0u) || ((argument & CONDITIONS) == 0u) ||
        (card.questions <= READY_AFTER)) {
        return answer_of(CONDITIONS);
    }
    card.state = READY;
    return answer_of(CONDITIONS | CONDITIONS_HIGH | CONDITIONS_UP);
}

/* ACMD6. */
static card_answer_t take_lines(uint32_t argument)
{
    if (card.state != TRANSFER) {
        return refuse();
    }
    card.is_wide = argument == 2u;
    return answer_status();
}

static card_answer_t begin_transfer(uint32_t sector, card_state_t state, bool is_single)
{
    if (card.state != TRANSFER) {
        return refuse();
    }
    if (sector >= card.sectors) {
        card.errors |= IS_OUT_OF_RANGE;
        return answer_status();
    }
    card.at = sector;
    card.is_single = is_single;
    return move_card(TRANSFER, state);
}

static card_answer_t read_block(uint32_t argument)
{
    return begin_transfer(argument, SENDING, true);
}

static card_answer_t read_blocks(uint32_t argument)
{
    return begin_transfer(argument, SENDING, false);
}

static card_answer_t write_block(uint32_t argument)
{
    return begin_transfer(argument, RECEIVING, true);
}

static card_answer_t write_blocks(uint32_t argument)
{
    return begin_transfer(argument, RECEIVING, false);
}

/* A command; those with an address are for the card that has it alone. */
typedef struct card_command {
    uint32_t index;
    bool has_address;
    bool is_application;
    card_answer_t (*obey)(uint32_t argument);
} card_command_t;

static const card_command_t commands[] = {
    {0u, false, false, go_idle},        {2u, false, false, tell_identity},
    {3u, false, false, tell_address},   {7u, true, false, select_card},
    {8u, false, false, tell_condition}, {9u, true, false, tell_data},
    {12u, false, false, stop_transfer}, {13u, true, false, tell_status},
    {17u, false, false, read_block},    {18u, false, false, read_blocks},
    {24u, false, false, write_block},   {25u, false, false, write_blocks},
    {55u, true, false, announce},       {6u, false, true, take_lines},
    {41u, false, true, tell_ready},
};

static card_answer_t obey(uint32_t index, uint32_t argument)
{
    const bool is_application = card.is_announced;

    end_programming();
    card.is_announced = false;
    for (uint32_t i = 0u; i < (sizeof commands / sizeof commands[0]); i++) {
        const card_command_t *const command = &commands[i];

        if ((command->index == index) && (command->is_application == is_application)) {
            return (command->has_address && ((argument & 0xFFFF0000u) != card.address))
                       ? (card_answer_t){NO_ANSWER, {0u}}
                       : command->obey(argument);
        }
    }
    return refuse();
}

/* --- Its slot: data. --- */

static uint64_t bit_ticks(void)
{
    const uint32_t divisor = keel_bits_get(slot_word(offsetof(keel_sdmmc_t, CLKCR)),
                                           SDMMC_CLKCR_CLKDIV) +
                             DIVISOR_ADD;

    return ((uint64_t)divisor * MODEL_TICKS_PER_US * 1000000u) / KERNEL_HZ;
}

static bool is_wide(void)
{
    return keel_bits_get(slot_word(offsetof(keel_sdmmc_t, CLKCR)), SDMMC_CLKCR_WIDBUS) ==
           FOUR_LINES;
}

static uint64_t byte_ticks(void)
{
    return (bit_ticks() * BYTE_BITS) / (is_wide() ? 4u : 1u);
}

static bool is_armed(bool to_host)
{
    const uint32_t control = slot_word(offsetof(keel_sdmmc_t, DCTRL));

    return ((control & SDMMC_DCTRL_DTEN) != 0u) &&
           (((control & SDMMC_DCTRL_DTDIR) != 0u) == to_host);
}

/* Bytes that have gone over the card's lines until now. */
static uint32_t moved(void)
{
    const bool has_begun = slot.moves && (model_now() > slot.begun);
    const uint64_t bytes = has_begun ? ((model_now() - slot.begun) / byte_ticks()) : 0u;

    return (bytes < slot.length) ? (uint32_t)bytes : slot.length;
}

static uint64_t moved_at(uint32_t bytes)
{
    return slot.begun + ((uint64_t)bytes * byte_ticks());
}

/* The card has a block, and says so; nobody says so where there is none. */
static void store_block(void)
{
    const uint32_t from = (slot.stored * SECTOR) % sizeof slot.ring;

    slot.stored++;
    if (!is_card_there() || (card.state != RECEIVING) || (card.at >= card.sectors)) {
        slot.flags |= SDMMC_STA_DCRCFAIL;
        slot.moves = false;
        return;
    }
    memcpy(&card.bytes[(size_t)card.at * SECTOR], &slot.ring[from], SECTOR);
    card.at++;
    slot.flags |= SDMMC_STA_DBCKEND |
                  ((slot.stored == (slot.length / SECTOR)) ? SDMMC_STA_DATAEND : 0u);
    if (card.is_single) {
        program();
    }
}

static uint64_t stored_at(void)
{
    return moved_at((slot.stored + 1u) * SECTOR) + (STATUS_BITS * bit_ticks());
}

/* What happened to data for the card up to now. */
static void pass_data_out(void)
{
    if ((slot.passed < slot.length) && (moved() >= slot.passed)) {
        slot.flags |= SDMMC_STA_TXUNDERR;
        slot.moves = false;
    }
    while (slot.moves && (slot.stored < (slot.length / SECTOR)) && (model_now() >= stored_at())) {
        store_block();
    }
}

/* The same for data from it. */
static void pass_data_in(void)
{
    if (!is_card_there() && (moved() < slot.length)) {
        slot.moves = false;
    } else if ((moved() - slot.passed) > FIFO_BYTES) {
        slot.flags |= SDMMC_STA_RXOVERR;
        slot.moves = false;
    } else {
        /* They come. */
    }
}

static void pass_data(void)
{
    if (slot.moves && is_armed(false)) {
        pass_data_out();
    } else if (slot.moves && is_armed(true)) {
        pass_data_in();
    } else if (is_armed(true) && (slot.passed < slot.length) && (model_now() >= slot.gives_up_at)) {
        slot.flags |= SDMMC_STA_DTIMEOUT;
    } else {
        /* Nothing moves. */
    }
}

/* The card sends what it was asked for. */
static void begin_data_in(void)
{
    if (!is_armed(true) || (card.state != SENDING)) {
        return;
    }
    if (card.is_wide != is_wide()) {
        model_fail("host and card use other lines");
    }
    if ((card.at + (slot.length / SECTOR)) > card.sectors) {
        model_fail("a transfer goes on behind the card's last sector");
        return;
    }
    slot.moves = true;
    slot.begun = slot.answered_at + ((uint64_t)ACCESS_US * MODEL_TICKS_PER_US);
}

static void arm_data(uint32_t control)
{
    const uint32_t length = slot_word(offsetof(keel_sdmmc_t, DLEN));
    const uint64_t clocks = slot_word(offsetof(keel_sdmmc_t, DTIMER));

    slot.moves = false;
    slot.passed = 0u;
    slot.stored = 0u;
    slot.length = 0u;
    if ((control & SDMMC_DCTRL_DTEN) == 0u) {
        return;
    }
    if ((length == 0u) || ((length % SECTOR) != 0u) ||
        (keel_bits_get(control, SDMMC_DCTRL_DBLOCKSIZE) != SECTOR_CODE)) {
        model_fail("a transfer is not of whole sectors");
    }
    if (clocks == 0u) {
        model_fail("a transfer has no time");
    }
    slot.length = length;
    slot.gives_up_at = model_now() + (clocks * bit_ticks());
}

static uint32_t take_word(void)
{
    uint32_t word = 0u;

    pass_data();
    if (!is_armed(true) || !slot.moves || ((moved() - slot.passed) < WORD)) {
        model_fail("the card's FIFO is read while it is empty");
        return 0u;
    }
    memcpy(&word, &card.bytes[((size_t)card.at * SECTOR) + slot.passed], WORD);
    slot.passed += WORD;
    if (slot.passed == slot.length) {
        slot.flags |= SDMMC_STA_DATAEND | SDMMC_STA_DBCKEND;
        card.state = card.is_single ? TRANSFER : SENDING;
    }
    return word;
}

static void give_word(uint32_t word)
{
    pass_data();
    if (!is_armed(false) || (slot.passed == slot.length)) {
        model_fail("the card's FIFO is written while nothing is sent");
        return;
    }
    if (((slot.flags & SDMMC_STA_TXUNDERR) == 0u) && ((slot.passed - moved()) >= FIFO_BYTES)) {
        model_fail("the card's FIFO is written while it is full");
    }
    if (!slot.moves && (slot.passed == 0u)) {
        if (is_card_there() && ((card.state != RECEIVING) || (card.is_wide != is_wide()))) {
            model_fail("data go to a card that expects none, or by other lines");
        }
        slot.moves = true;
        slot.begun = model_now() + (HALF * byte_ticks());
    }
    memcpy(&slot.ring[slot.passed % sizeof slot.ring], &word, WORD);
    slot.passed += WORD;
}

/* --- Its slot: commands. --- */

static bool has_pins(void)
{
    bool all = model_pin_has(3u, 2u, CARD_FUNCTION);

    for (uint32_t pin = 8u; pin <= 12u; pin++) {
        all = all && model_pin_has(2u, pin, CARD_FUNCTION);
    }
    return all;
}

/* The clock of 48 MHz that the PLL makes of the crystal's 16. */
static bool has_clock(void)
{
    const uint32_t pll = *model_word(RCC_BASE + offsetof(keel_rcc_t, PLLCFGR));
    const uint32_t choice = *model_word(RCC_BASE + offsetof(keel_rcc_t, DCKCFGR2));
    const uint32_t m = keel_bits_get(pll, RCC_PLLCFGR_PLLM);
    const uint32_t n = keel_bits_get(pll, RCC_PLLCFGR_PLLN);
    const uint32_t q = keel_bits_get(pll, RCC_PLLCFGR_PLLQ);

    return ((pll & RCC_PLLCFGR_PLLSRC) != 0u) && ((16u * n) == (48u * m * q)) &&
           ((choice & (RCC_DCKCFGR2_CK48MSEL | RCC_DCKCFGR2_SDMMC1SEL)) == 0u) &&
           ((*model_word(RCC_BASE + offsetof(keel_rcc_t, APB2ENR)) & RCC_APB2ENR_SDMMC1EN) != 0u);
}

/* What must hold when a command goes out. */
static void check_slot(void)
{
    const bool is_unknown = !is_card_there() || (card.state < STANDBY);
    const uint32_t limit = is_unknown ? IDENTIFY_HZ : TRANSFER_HZ;
    const uint32_t clock = slot_word(offsetof(keel_sdmmc_t, CLKCR));
    const uint32_t divisor = keel_bits_get(clock, SDMMC_CLKCR_CLKDIV) + DIVISOR_ADD;
    const uint32_t power = keel_bits_get(slot_word(offsetof(keel_sdmmc_t, POWER)),
                                         SDMMC_POWER_PWRCTRL);

    if (!has_clock()) {
        model_fail("a command goes to the card, but SDMMC1 has no clock of 48 MHz");
    } else if (!has_pins()) {
        model_fail("a command goes to the card, but a pin is not its own");
    } else if (!model_pin_is_high(POWER_PORT, POWER_PIN) || (power != POWER_ON)) {
        model_fail("a command goes to the card, but its supply is off");
    } else if (((clock & SDMMC_CLKCR_CLKEN) == 0u) ||
               (is_card_there() && ((KERNEL_HZ / divisor) > limit))) {
        model_fail("a command goes to the card, but its clock is %u Hz",
                   ((clock & SDMMC_CLKCR_CLKEN) == 0u) ? 0u : (unsigned)(KERNEL_HZ / divisor));
    } else {
        /* All is as it must be. */
    }
}

static void note_answer(uint32_t index, uint32_t wanted, const card_answer_t *answer)
{
    const bool is_long = answer->count > 1u;
    const bool has_checksum = index != 41u; /* And an index. */

    if (is_long != (wanted == LONG_ANSWER)) {
        model_fail("command %u expects an answer of another length", (unsigned)index);
    }
    *model_word(SDMMC1_BASE + offsetof(keel_sdmmc_t, RESPCMD)) = has_checksum ? index : 0x3Fu;
    for (uint32_t i = 0u; i < answer->count; i++) {
        *model_word(SDMMC1_BASE + offsetof(keel_sdmmc_t, RESP1) + (WORD * i)) = answer->word[i];
    }
    slot.answers = has_checksum ? SDMMC_STA_CMDREND : SDMMC_STA_CCRCFAIL;
    slot.answered_at = model_now() +
                       ((COMMAND_BITS + (is_long ? LONG_BITS : SHORT_BITS)) * bit_ticks());
}

static void send_command(uint32_t command)
{
    const uint32_t index = keel_bits_get(command, SDMMC_CMD_CMDINDEX);
    const uint32_t wanted = keel_bits_get(command, SDMMC_CMD_WAITRESP);
    card_answer_t answer = {NO_ANSWER, {0u}};

    check_slot();
    pass_data();
    if (is_card_there()) {
        answer = obey(index, slot_word(offsetof(keel_sdmmc_t, ARG)));
    }
    if ((wanted != SHORT_ANSWER) && (wanted != LONG_ANSWER)) {
        slot.answers = SDMMC_STA_CMDSENT;
        slot.answered_at = model_now() + (COMMAND_BITS * bit_ticks());
    } else if (answer.count == NO_ANSWER) {
        slot.answers = SDMMC_STA_CTIMEOUT;
        slot.answered_at = model_now() + ((COMMAND_BITS + PATIENCE_BITS) * bit_ticks());
    } else {
        note_answer(index, wanted, &answer);
        begin_data_in();
    }
}

/* --- Its slot: registers. --- */

/* When something happens next to the data, for those who wait. */
static uint64_t next_event(void)
{
    if (slot.moves && is_armed(true)) {
        return moved_at(slot.passed + HALF);
    }
    if (slot.moves && is_armed(false)) {
        return (slot.passed < slot.length) ? moved_at((slot.passed + HALF) - FIFO_BYTES)
                                           : stored_at();
    }
    return is_armed(true) ? slot.gives_up_at : model_now();
}

static uint32_t levels(void)
{
    if (is_armed(true) && slot.moves) {
        return (((moved() - slot.passed) >= HALF) ? SDMMC_STA_RXFIFOHF : 0u) |
               ((moved() < slot.length) ? SDMMC_STA_RXACT : 0u);
    }
    return (is_armed(false) && (slot.passed < slot.length) &&
            ((slot.passed + HALF) <= (moved() + FIFO_BYTES)))
               ? SDMMC_STA_TXFIFOHE
               : 0u;
}

/* Whether a look finds something: of data, while there are any. */
static bool finds_something(void)
{
    const bool has_data = is_armed(true) || is_armed(false);
    const uint32_t looked_at = slot.flags | (levels() & ~SDMMC_STA_RXACT);

    return (looked_at & (has_data ? ~COMMAND_FLAGS : UINT32_MAX)) != 0u;
}

/* Who finds nothing waits for what comes next. */
static uint32_t read_status(void)
{
    pass_data();
    if (!finds_something()) {
        (void)model_wait((slot.answers != 0u) ? slot.answered_at : next_event());
    }
    if ((slot.answers != 0u) && (model_now() >= slot.answered_at)) {
        slot.flags |= slot.answers;
        slot.answers = 0u;
    }
    pass_data();
    return slot.flags | levels();
}

uint32_t model_slot_read(uint32_t offset)
{
    if (offset == offsetof(keel_sdmmc_t, STA)) {
        return read_status();
    }
    return (offset == offsetof(keel_sdmmc_t, FIFO)) ? take_word() : slot_word(offset);
}

void model_slot_write(uint32_t offset, uint32_t value)
{
    *model_word(SDMMC1_BASE + offset) = value;
    if (offset == offsetof(keel_sdmmc_t, ICR)) {
        pass_data();
        slot.flags &= ~value;
    } else if (offset == offsetof(keel_sdmmc_t, DCTRL)) {
        arm_data(value);
    } else if (offset == offsetof(keel_sdmmc_t, FIFO)) {
        give_word(value);
    } else if ((offset == offsetof(keel_sdmmc_t, CMD)) && ((value & SDMMC_CMD_CPSMEN) != 0u)) {
        send_command(value);
    } else {
        /* It is kept. */
    }
}

/* --- Its slot: what is in it. --- */

void model_card_insert(uint8_t *bytes, uint32_t sectors)
{
    card = (model_card_t){.bytes = bytes, .sectors = sectors};
}

void model_card_start(void)
{
    card.is_out = false;
    card.is_stuck = false;
    model_card_reset();
}

/* The pin that switches its supply floats. */
void model_card_reset(void)
{
    slot = (model_slot_t){0};
    power_card();
}

bool model_card_pull(bool is_out)
{
    pass_data();
    card.is_out = is_out;
    power_card();
    return card.bytes != NULL;
}

bool model_card_stick(bool is_stuck)
{
    card.is_stuck = is_stuck;
    return card.bytes != NULL;
}
