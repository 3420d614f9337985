//! Buffers that take what a picture needs and grow when it needs more.

use bytemuck::Pod;

use crate::gpu::Gpu;

/// A buffer that is written anew for every picture. It doubles when it is too small and never
/// shrinks, so that after a few pictures none is made any more.
#[derive(Debug)]
pub(crate) struct GrowBuffer {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: wgpu::Buffer,
    /// Elements written last.
    len: u32,
}

const LEAST_BYTES: u64 = 4096;

impl GrowBuffer {
    /// An empty buffer.
    pub(crate) fn new(gpu: &Gpu, label: &'static str, usage: wgpu::BufferUsages) -> Self {
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        Self { label, usage, buffer: make(gpu, label, usage, LEAST_BYTES), len: 0 }
    }

    /// Replaces what is in it; gives whether the buffer itself was replaced.
    pub(crate) fn write<T: Pod>(&mut self, gpu: &Gpu, elements: &[T]) -> bool {
        let bytes: &[u8] = bytemuck::cast_slice(elements);
        self.len = elements.len() as u32;
        let needs = bytes.len() as u64;
        let must_grow = needs > self.buffer.size();
        if must_grow {
            let size = needs.next_power_of_two();
            self.buffer = make(gpu, self.label, self.usage, size);
        }
        if needs > 0 {
            gpu.queue().write_buffer(&self.buffer, 0, bytes);
        }
        must_grow
    }

    /// The buffer.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// How many elements were written last.
    pub(crate) fn len(&self) -> u32 {
        self.len
    }
}

fn make(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    gpu.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    })
}

/// A buffer with what will stay in it.
pub(crate) fn fixed_buffer<T: Pod>(
    gpu: &Gpu,
    label: &str,
    usage: wgpu::BufferUsages,
    elements: &[T],
) -> wgpu::Buffer {
    let bytes: &[u8] = bytemuck::cast_slice(elements);
    let usage = usage | wgpu::BufferUsages::COPY_DST;
    let size = (bytes.len() as u64).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT).max(16);
    let buffer = make(gpu, label, usage, size);
    gpu.queue().write_buffer(&buffer, 0, bytes);
    buffer
}
