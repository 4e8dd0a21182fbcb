// SPDX-License-Identifier: Apache-2.0
//! What decoders of others say of one frame, for C: tests/fuzz/oracles.h tells what each gives.

use crsf::{Packet, PacketParser};
use parse_rc_ibus::IbusPacket;
use ppm_decode::PpmParser;
use std::slice::from_raw_parts;
use ublox::{proto14, proto14::Proto14, proto23, proto23::Proto23, Parser, UbxPacket};
use uf_sbus::SbusParser;

const SBUS_BYTES: usize = 25;
const CRSF_BYTES: usize = 64;
const IBUS_BYTES: usize = 32;
const PPM_CHANNELS: usize = 16;

/// # Safety
/// `frame` is 25 bytes.
#[no_mangle]
pub unsafe extern "C" fn oracle_sbus(frame: *const u8, channel: &mut [u16; 16], flags: &mut u8) -> bool {
    let mut parser = SbusParser::new();
    let packets = parser.iter_packets(from_raw_parts(frame, SBUS_BYTES)).flatten();
    let Some(packet) = packets.last() else {
        return false;
    };
    *channel = packet.channels;
    *flags = u8::from(packet.channel_17)
        | u8::from(packet.channel_18) << 1
        | u8::from(packet.frame_lost) << 2
        | u8::from(packet.failsafe) << 3;
    true
}

/// # Safety
/// `frame` is `size` bytes, 64 at most.
#[no_mangle]
pub unsafe extern "C" fn oracle_crsf(frame: *const u8, size: usize, channel: &mut [u16; 16], link: &mut [u8; 6]) -> i32 {
    let mut parser = PacketParser::<CRSF_BYTES>::new();
    parser.push_bytes(from_raw_parts(frame, size));
    match parser.next_packet() {
        Some(Ok((_, Packet::RcChannels(channels)))) => {
            *channel = channels.0;
            1
        }
        Some(Ok((_, Packet::LinkStatistics(said)))) => {
            *link = [
                said.uplink_rssi_1,
                said.uplink_rssi_2,
                said.uplink_link_quality,
                said.uplink_snr as u8,
                said.active_antenna,
                said.rf_mode,
            ];
            2
        }
        _ => 0,
    }
}

/// # Safety
/// `frame` is 32 bytes.
#[no_mangle]
pub unsafe extern "C" fn oracle_ibus(frame: *const u8, channel: &mut [u16; 14]) -> bool {
    let bytes: &[u8; IBUS_BYTES] = &*frame.cast();
    match IbusPacket::try_from_bytes(bytes) {
        Ok(packet) => {
            *channel = packet.get_all_channels();
            true
        }
        Err(_) => false,
    }
}

/// # Safety
/// `width` is `count` times, 20 at most, which the decoder has room for: it looks at no bound.
#[no_mangle]
pub unsafe extern "C" fn oracle_ppm(width: *const u32, count: usize, least: u8, channel: &mut [u16; PPM_CHANNELS]) -> u32 {
    let mut parser = PpmParser::new();
    let mut now = 1;
    let mut taken = 0;
    parser.set_minimum_channels(least);
    parser.handle_pulse_start(now);
    for after in from_raw_parts(width, count) {
        now += after;
        parser.handle_pulse_start(now);
        taken = 0;
        if let Some(frame) = parser.next_frame() {
            taken = u32::from(frame.chan_count);
            for (to, from) in channel.iter_mut().zip(frame.chan_values) {
                *to = from as u16;
            }
        }
    }
    taken
}

// The fields of a NAV-PVT: those of both protocols have the same names, but not the same type.
macro_rules! fields {
    ($pvt:expr) => {
        [
            i64::from($pvt.itow()),
            i64::from($pvt.longitude_raw()),
            i64::from($pvt.latitude_raw()),
            i64::from($pvt.height_msl_raw()),
            i64::from($pvt.horizontal_accuracy_raw()),
            i64::from($pvt.vertical_accuracy_raw()),
            i64::from($pvt.vel_north_raw()),
            i64::from($pvt.vel_east_raw()),
            i64::from($pvt.vel_down_raw()),
            i64::from($pvt.speed_accuracy_raw()),
            i64::from($pvt.fix_type_raw()),
            i64::from($pvt.num_satellites()),
            i64::from($pvt.flags_raw() & 1),
        ]
    };
}

/// # Safety
/// `message` is `size` bytes.
#[no_mangle]
pub unsafe extern "C" fn oracle_ubx_14(message: *const u8, size: usize, fix: &mut [i64; 13]) -> bool {
    let mut parser = Parser::<Vec<u8>, Proto14>::default();
    let mut found = parser.consume_ubx(from_raw_parts(message, size));
    while let Some(packet) = found.next() {
        if let Ok(UbxPacket::Proto14(proto14::PacketRef::NavPvt(pvt))) = packet {
            *fix = fields!(pvt);
            return true;
        }
    }
    false
}

/// # Safety
/// `message` is `size` bytes.
#[no_mangle]
pub unsafe extern "C" fn oracle_ubx(message: *const u8, size: usize, fix: &mut [i64; 13]) -> bool {
    let mut parser = Parser::<Vec<u8>, Proto23>::default();
    let mut found = parser.consume_ubx(from_raw_parts(message, size));
    while let Some(packet) = found.next() {
        if let Ok(UbxPacket::Proto23(proto23::PacketRef::NavPvt(pvt))) = packet {
            *fix = fields!(pvt);
            return true;
        }
    }
    false
}
