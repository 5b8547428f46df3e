//! Reader of compressed buffer views (`EXT_meshopt_compression`): vertices of version 0 and triangles.
//!
//! Specification: Khronos Group, "EXT_meshopt_compression", 2021, appendix A.

/// Number of values whose sizes are stored together.
const GROUP: usize = 16;

/// Bytes that are read one after another.
struct ByteReader<'a>(&'a [u8]);

impl<'a> ByteReader<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|bytes| bytes[0])
    }

    /// Returns a number of seven bits a byte, the lowest first.
    fn number(&mut self) -> Option<u32> {
        let mut number = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.byte()?;
            number |= u32::from(byte & 127) << shift;
            if byte < 128 {
                break;
            }
        }
        Some(number)
    }
}

/// Returns `count` vertices of `stride` bytes; `None` if `packed` is invalid.
pub(super) fn unpack_vertices(packed: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let (header, body) = packed.split_first()?;
    if *header != 0xa0 || stride == 0 || !stride.is_multiple_of(4) || stride > 256 {
        return None;
    }
    let tail = body.len().checked_sub(stride.max(32))?;
    let mut last = body.get(body.len() - stride..)?.to_vec();
    let mut reader = ByteReader(&body[..tail]);
    let mut vertices = vec![0; count.checked_mul(stride)?];
    let most = (8192 / stride / GROUP * GROUP).min(256);
    for block in vertices.chunks_mut(most * stride) {
        let items = block.len() / stride;
        let groups = items.div_ceil(GROUP);
        for axis in 0..stride {
            let sizes = reader.take(groups.div_ceil(4))?;
            for group in 0..groups {
                let values = unpack_group(&mut reader, sizes[group / 4] >> (group % 4 * 2) & 3)?;
                for (offset, value) in values.into_iter().enumerate().take(items - (group * GROUP).min(items))
                {
                    // The lowest bit is the sign of a difference.
                    let difference = (value >> 1) ^ (value & 1).wrapping_neg();
                    last[axis] = last[axis].wrapping_add(difference);
                    block[(group * GROUP + offset) * stride + axis] = last[axis];
                }
            }
        }
    }
    reader.0.is_empty().then_some(vertices)
}

/// Returns a group of values of 0, 2, 4 or 8 bits. The largest value of 2 or 4 bits refers to a byte after the group.
fn unpack_group(reader: &mut ByteReader<'_>, size: u8) -> Option<[u8; GROUP]> {
    let bits = match size {
        0 => return Some([0; GROUP]),
        3 => return reader.take(GROUP)?.try_into().ok(),
        size => usize::from(size) * 2,
    };
    let (packed, largest) = (reader.take(GROUP * bits / 8)?, (1_u8 << bits) - 1);
    let mut values = [0; GROUP];
    for (index, value) in values.iter_mut().enumerate() {
        let at = index * bits;
        *value = packed[at / 8] >> (8 - bits - at % 8) & largest;
        if *value == largest {
            *value = reader.byte()?;
        }
    }
    Some(values)
}

/// The last 16 items.
struct LastItems<T> {
    items: [T; 16],
    next: usize,
}

impl<T: Copy> LastItems<T> {
    fn push(&mut self, item: T) {
        self.items[self.next & 15] = item;
        self.next += 1;
    }

    /// Returns the item that was added `back` items ago, 1 for the last.
    fn get(&self, back: usize) -> T {
        self.items[self.next.wrapping_sub(back) & 15]
    }
}

/// State of the reader of triangles.
struct TriangleReader<'a> {
    data: ByteReader<'a>,
    edges: LastItems<[u32; 2]>,
    vertices: LastItems<u32>,
    /// Number of the next new vertex.
    next: u32,
    /// Last vertex that was stored as a difference.
    last: u32,
}

impl TriangleReader<'_> {
    fn fresh(&mut self) -> u32 {
        self.next = self.next.wrapping_add(1);
        self.next.wrapping_sub(1)
    }

    fn stored(&mut self) -> Option<u32> {
        let number = self.data.number()?;
        self.last = self.last.wrapping_add((number >> 1) ^ (number & 1).wrapping_neg());
        Some(self.last)
    }

    /// Returns the third corner of a triangle at a known edge.
    fn corner(&mut self, code: u8, is_new: bool) -> Option<u32> {
        let corner = match code {
            0 => self.fresh(),
            13 | 14 if is_new => {
                self.last = if code == 13 { self.last.wrapping_sub(1) } else { self.last.wrapping_add(1) };
                self.last
            }
            15 => self.stored()?,
            back => return Some(self.vertices.get(usize::from(back) + 1)),
        };
        self.vertices.push(corner);
        Some(corner)
    }

    /// Returns a triangle without a known edge. `codes` are those of its corners.
    fn triangle(&mut self, codes: [u8; 3]) -> Option<[u32; 3]> {
        let mut corners = [0; 3];
        // New vertices are numbered, and known ones are found, before any of them is stored.
        for (corner, code) in corners.iter_mut().zip(codes) {
            *corner = match code {
                0 => self.fresh(),
                15 => 0,
                back => self.vertices.get(usize::from(back)),
            };
        }
        for (corner, code) in corners.iter_mut().zip(codes) {
            if code == 15 {
                *corner = self.stored()?;
            }
        }
        for (number, (corner, code)) in corners.iter().zip(codes).enumerate() {
            if number == 0 || code == 0 || code == 15 {
                self.vertices.push(*corner);
            }
        }
        Some(corners)
    }
}

/// Returns `count` indices of triangles; `None` if `packed` is invalid.
pub(super) fn unpack_triangles(packed: &[u8], count: usize) -> Option<Vec<u32>> {
    let (header, body) = packed.split_first()?;
    let (codes, rest) = body.split_at_checked(count / 3)?;
    if header & 0xf0 != 0xe0 || header & 15 > 1 || !count.is_multiple_of(3) {
        return None;
    }
    let is_new = *header == 0xe1;
    let (data, table) = rest.split_at_checked(rest.len().checked_sub(16)?)?;
    let mut reader = TriangleReader {
        data: ByteReader(data),
        edges: LastItems { items: [[u32::MAX; 2]; 16], next: 0 },
        vertices: LastItems { items: [u32::MAX; 16], next: 0 },
        next: 0,
        last: 0,
    };
    let mut indices = Vec::with_capacity(count);
    for code in codes {
        if *code < 0xf0 {
            let [a, b] = reader.edges.get(usize::from(code >> 4) + 1);
            let c = reader.corner(code & 15, is_new)?;
            reader.edges.push([c, b]);
            reader.edges.push([a, c]);
            indices.extend([a, b, c]);
            continue;
        }
        let others = match code {
            0xfe | 0xff => reader.data.byte()?,
            code => table[usize::from(code & 15)],
        };
        if others == 0 && *code >= 0xfe {
            reader.next = 0;
        }
        let first = if *code == 0xff { 15 } else { 0 };
        let [a, b, c] = reader.triangle([first, others >> 4, others & 15])?;
        for edge in [[b, a], [c, b], [a, c]] {
            reader.edges.push(edge);
        }
        indices.extend([a, b, c]);
    }
    reader.data.0.is_empty().then_some(indices)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Generates bytes that differ little from one item to the next, or at random.
    fn bytes(stride: usize) -> impl Strategy<Value = Vec<u8>> {
        let item = (0..4_u8, prop::collection::vec(any::<u8>(), stride));
        prop::collection::vec(item, 0..700).prop_map(move |items| {
            let mut last = vec![7_u8; stride];
            let mut all = Vec::new();
            for (size, item) in items {
                for (value, random) in last.iter_mut().zip(item) {
                    *value = value.wrapping_add(random >> (8 - 2 * u32::from(size + 1)));
                }
                all.extend_from_slice(&last);
            }
            all
        })
    }

    proptest! {
        #[test]
        fn vertices_that_another_program_packed_are_read(
            short in bytes(4), long in bytes(12), cut in any::<prop::sample::Index>()
        ) {
            let short_items: &[[u8; 4]] = short.as_chunks().0;
            let long_items: &[[u8; 12]] = long.as_chunks().0;
            let packed = meshopt::encode_vertex_buffer_level(short_items, 2, Some(0)).unwrap();
            prop_assert_eq!(unpack_vertices(&packed, short_items.len(), 4), Some(short));
            let packed = meshopt::encode_vertex_buffer_level(long_items, 2, Some(0)).unwrap();
            prop_assert_eq!(unpack_vertices(&packed, long_items.len(), 12), Some(long.clone()));
            // A file that is cut short is refused, or read as other vertices, and causes no panic.
            let _ = unpack_vertices(&packed[..cut.index(packed.len())], long.len() / 12, 12);
        }

        #[test]
        fn triangles_that_another_program_packed_are_read(
            fans in prop::collection::vec((0..900_u32, 0..6_u32, 0..40_u32), 0..200), cut in any::<prop::sample::Index>()
        ) {
            let fan = |(first, count, step): (u32, u32, u32)| {
                (0..count).flat_map(move |corner| [first, first + 1 + corner, first + 2 + corner + step])
            };
            let indices: Vec<u32> = fans.into_iter().flat_map(fan).collect();
            let packed = meshopt::encode_index_buffer(&indices, 1000).unwrap();
            let read = unpack_triangles(&packed, indices.len()).unwrap();
            prop_assert_eq!(read.len(), indices.len());
            for (read, given) in read.chunks(3).zip(indices.chunks(3)) {
                // A triangle may begin at another corner.
                let turned = [0, 1, 2].map(|turn| [0, 1, 2].map(|corner| given[(corner + turn) % 3]));
                prop_assert!(turned.iter().any(|corners| corners == read), "{:?} {:?}", read, given);
            }
            let _ = unpack_triangles(&packed[..cut.index(packed.len())], indices.len());
        }
    }
}
