//! A server for one person: HTTP/1.1 on a port of this machine, a thread and one answer a connection, all bounded.
//!
//! It is our own because the small libraries have no bound on how long a client takes: a client that sends a byte now
//! and then would hold a thread for ever. The head is read by the crate `httparse`, which hyper uses.

use super::request::{MAX_HEAD, judge};
use super::response::{Status, answer, refusal};
use super::site::Site;
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How much a client may take.
#[derive(Clone, Copy)]
pub struct Bounds {
    /// The time until the whole head has arrived.
    pub head: Duration,
    /// The time until the whole answer is taken.
    pub answer: Duration,
    /// The time for a client to read the answer and close, while what it still sends is thrown away.
    pub farewell: Duration,
    /// Connections at a time.
    pub connections: usize,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds {
            head: Duration::from_secs(5),
            answer: Duration::from_secs(30),
            farewell: Duration::from_secs(1),
            connections: 32,
        }
    }
}

/// What a request is held against.
pub struct Door {
    /// What is served.
    pub site: Site,
    /// The first part of every address, 128 random bits.
    pub token: String,
    /// The values of `Host` that mean this server.
    pub hosts: Vec<String>,
}

/// A server that is bound to its port.
pub struct Server {
    listener: TcpListener,
    port: u16,
    door: Arc<Door>,
    guests: Arc<Guests>,
    bounds: Bounds,
}

impl Server {
    /// Takes a port of 127.0.0.1, any free one for 0, and a new token.
    ///
    /// # Errors
    /// If the port is taken, or the system has no random numbers.
    pub fn bind(site: Site, port: u16, bounds: Bounds) -> io::Result<Server> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let port = listener.local_addr()?.port();
        let mut random = [0; 16];
        getrandom::fill(&mut random).map_err(|e| io::Error::other(e.to_string()))?;
        let token = random.iter().map(|b| format!("{b:02x}")).collect();
        let mut hosts = vec![format!("127.0.0.1:{port}"), format!("localhost:{port}")];
        if port == 80 {
            // Browsers leave out the port that they would take anyway.
            hosts.extend(["127.0.0.1".into(), "localhost".into()]);
        }
        let door = Arc::new(Door { site, token, hosts });
        let guests = Arc::new(Guests { most: bounds.connections, present: Mutex::default() });
        Ok(Server { listener, port, door, guests, bounds })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.door.token)
    }

    /// Answers until the program is ended.
    pub fn run(&self) -> ! {
        let mut number = 0;
        loop {
            let stream = match self.listener.accept() {
                Ok((stream, _)) => Arc::new(stream),
                Err(_) => {
                    // Out of files, say: what is open has to end first.
                    thread::sleep(Duration::from_millis(50));
                    continue;
                }
            };
            number += 1;
            let Some(guest) = Guests::admit(&self.guests, number, stream) else { continue };
            let (door, bounds) = (self.door.clone(), self.bounds);
            // A connection for which there is no thread is closed with the closure that holds it; one that breaks off
            // concerns nobody else.
            let _ = thread::Builder::new().spawn(move || serve(&guest, &door, bounds));
        }
    }
}

/// The connections that are open, the oldest first.
///
/// Where there is no room, the oldest that has asked for nothing yet makes it. So no number of idle connections keeps
/// anybody out. If all are being answered, which only those are who know the token, the new one is closed.
struct Guests {
    most: usize,
    present: Mutex<VecDeque<Present>>,
}

struct Present {
    number: u64,
    stream: Arc<TcpStream>,
    is_answered: bool,
}

/// One connection; gives back its place when it is dropped.
struct Guest {
    number: u64,
    stream: Arc<TcpStream>,
    guests: Arc<Guests>,
}

impl Guests {
    fn present(&self) -> MutexGuard<'_, VecDeque<Present>> {
        self.present.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn admit(guests: &Arc<Guests>, number: u64, stream: Arc<TcpStream>) -> Option<Guest> {
        let mut present = guests.present();
        if present.len() >= guests.most {
            let idle = present.iter().position(|p| !p.is_answered)?;
            if let Some(leaves) = present.remove(idle) {
                // Its thread wakes up with nothing to read.
                let _ = leaves.stream.shutdown(Shutdown::Both);
            }
        }
        present.push_back(Present { number, stream: stream.clone(), is_answered: false });
        Some(Guest { number, stream, guests: guests.clone() })
    }
}

impl Guest {
    fn set_answered(&self, is_answered: bool) {
        for guest in self.guests.present().iter_mut().filter(|p| p.number == self.number) {
            guest.is_answered = is_answered;
        }
    }
}

impl Drop for Guest {
    fn drop(&mut self) {
        self.guests.present().retain(|p| p.number != self.number);
    }
}

/// One request, one answer.
fn serve(guest: &Guest, door: &Door, bounds: Bounds) -> io::Result<()> {
    let stream = &*guest.stream;
    stream.set_nodelay(true)?;
    let bytes = read(guest, door, Instant::now() + bounds.head)?;
    write(stream, &bytes, Instant::now() + bounds.answer)?;
    guest.set_answered(false);
    farewell(stream, Instant::now() + bounds.farewell)
}

/// Reads the head until it is certain what to answer, and makes the answer.
fn read(guest: &Guest, door: &Door, deadline: Instant) -> io::Result<Vec<u8>> {
    let mut head = [0; MAX_HEAD];
    let mut length = 0;
    loop {
        match receive(&guest.stream, &mut head[length..], deadline) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(n) => length += n,
            // A browser opens connections in advance; one that was not needed hears nothing.
            Err(e) if e.kind() == ErrorKind::TimedOut && length > 0 => return Ok(refusal(Status::TIMED_OUT)),
            Err(e) => return Err(e),
        }
        match judge(&head[..length], door) {
            Ok(None) => {}
            Ok(Some(asked)) => {
                guest.set_answered(true);
                return answer(&asked);
            }
            Err(status) => return Ok(refusal(status)),
        }
    }
}

/// Closes this side, and reads what was still sent: a connection that is closed with something unread is reset, and the
/// client may lose the answer.
fn farewell(stream: &TcpStream, deadline: Instant) -> io::Result<()> {
    const MOST: usize = 256 * 1024;
    stream.shutdown(Shutdown::Write)?;
    let (mut waste, mut total) = ([0; 4096], 0);
    while total < MOST {
        match receive(stream, &mut waste, deadline)? {
            0 => break,
            n => total += n,
        }
    }
    Ok(())
}

/// What has arrived, if anything does before the deadline.
fn receive(mut stream: &TcpStream, into: &mut [u8], deadline: Instant) -> io::Result<usize> {
    loop {
        stream.set_read_timeout(Some(left(deadline)?))?;
        match stream.read(into) {
            Err(e) if is_passing(&e) => {}
            done => return done,
        }
    }
}

/// Everything, if it is taken before the deadline.
fn write(mut stream: &TcpStream, mut bytes: &[u8], deadline: Instant) -> io::Result<()> {
    while !bytes.is_empty() {
        stream.set_write_timeout(Some(left(deadline)?))?;
        match stream.write(bytes) {
            Ok(0) => return Err(ErrorKind::WriteZero.into()),
            Ok(n) => bytes = &bytes[n..],
            Err(e) if is_passing(&e) => {}
            Err(e) => return Err(e),
        }
    }
    Ok(())
}

/// The time until the deadline, no less than a socket takes.
fn left(deadline: Instant) -> io::Result<Duration> {
    match deadline.saturating_duration_since(Instant::now()) {
        Duration::ZERO => Err(ErrorKind::TimedOut.into()),
        left => Ok(left.max(Duration::from_millis(1))),
    }
}

/// Nothing is wrong, or the time is over, which `left` decides.
fn is_passing(e: &io::Error) -> bool {
    matches!(e.kind(), ErrorKind::Interrupted | ErrorKind::WouldBlock | ErrorKind::TimedOut)
}
