//! From a texture to bytes.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::gpu::Gpu;

const IDLE: u8 = 0;
const PENDING: u8 = 1;
const READY: u8 = 2;
const FAILED: u8 = 3;

/// A buffer into which a texture of four bytes a texel is copied, and its way to the processor.
#[derive(Debug)]
pub(crate) struct Readback {
    width_px: u32,
    height_px: u32,
    bytes_per_row: u32,
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

impl Readback {
    /// For textures of one size.
    pub(crate) fn new(gpu: &Gpu, width_px: u32, height_px: u32) -> Self {
        // Rows of a copy begin at multiples of 256 bytes.
        let bytes_per_row = (4 * width_px).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(bytes_per_row) * u64::from(height_px),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { width_px, height_px, bytes_per_row, buffer, state: Arc::default() }
    }

    /// Records the copy. What was asked before is dropped.
    pub(crate) fn copy(&mut self, encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture) {
        if self.state.load(Ordering::Acquire) != IDLE {
            self.buffer.unmap();
            // A late answer to the old question must not count for the new one.
            self.state = Arc::default();
        }
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.bytes_per_row),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width: self.width_px,
                height: self.height_px,
                depth_or_array_layers: 1,
            },
        );
    }

    /// Asks for the bytes; to be called when the copy has been submitted.
    pub(crate) fn begin(&mut self) {
        self.state.store(PENDING, Ordering::Release);
        let state = Arc::clone(&self.state);
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            state.store(if result.is_ok() { READY } else { FAILED }, Ordering::Release);
        });
    }

    /// The bytes, row after row without gaps, once they are there.
    pub(crate) fn poll(&mut self, gpu: &Gpu) -> Option<Vec<u8>> {
        // What goes wrong shows as a failed mapping or a lost device.
        let _polled = gpu.device().poll(wgpu::PollType::Poll);
        self.take()
    }

    /// Waits for the bytes; `None` if the device is gone.
    pub(crate) fn wait(&mut self, gpu: &Gpu) -> Option<Vec<u8>> {
        while self.state.load(Ordering::Acquire) == PENDING {
            if gpu.is_lost() || gpu.device().poll(wgpu::PollType::wait_indefinitely()).is_err() {
                return None;
            }
        }
        self.take()
    }

    fn take(&mut self) -> Option<Vec<u8>> {
        match self.state.load(Ordering::Acquire) {
            READY => {}
            FAILED => {
                self.state.store(IDLE, Ordering::Release);
                return None;
            }
            _ => return None,
        }
        let mut out = Vec::with_capacity(4 * (self.width_px * self.height_px) as usize);
        {
            let mapped = self.buffer.slice(..).get_mapped_range().ok()?;
            for row in mapped.chunks_exact(self.bytes_per_row as usize) {
                out.extend_from_slice(&row[..4 * self.width_px as usize]);
            }
        }
        self.buffer.unmap();
        self.state.store(IDLE, Ordering::Release);
        Some(out)
    }
}
