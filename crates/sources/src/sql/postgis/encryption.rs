//! The encryption of connections, and the verification of servers.
//!
//! Source: PostgreSQL's manual, "SSL Support".

use std::future::Future;
use std::io;
use std::path::Path;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::client::{WebPkiServerVerifier, verify_server_name};
use rustls::crypto::{CryptoProvider, ring, verify_tls12_signature, verify_tls13_signature};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::server::ParsedCertificate;
use rustls::{
    CertificateError, ClientConfig, DigitallySignedStruct, Error as TlsError, OtherError, RootCertStore,
    SignatureScheme,
};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio_postgres::config::SslMode;
use tokio_postgres::tls::{ChannelBinding, MakeTlsConnect, TlsConnect, TlsStream};

use super::{EncryptionMode, ServerAddress};
use burgeon_base::error::{Error, Result};

/// Certificate bundles of operating systems, in the order of the search.
const BUNDLES: [&str; 6] = [
    "/etc/ssl/certs/ca-certificates.crt",
    "/etc/pki/tls/certs/ca-bundle.crt",
    "/etc/ssl/ca-bundle.pem",
    "/etc/ssl/cert.pem",
    "/opt/homebrew/etc/ca-certificates/cert.pem",
    "/usr/local/etc/openssl/cert.pem",
];

/// The encryption of the connections to a server.
#[derive(Clone)]
pub(super) struct Encryption {
    config: Arc<ClientConfig>,
}

impl Encryption {
    /// Creates the encryption that an address specifies. Fails if the certificates of authorities cannot be read.
    pub(super) fn new(address: &ServerAddress) -> Result<Self> {
        let provider = Arc::new(ring::default_provider());
        let chain = match address.encryption {
            EncryptionMode::Disable | EncryptionMode::Prefer | EncryptionMode::Require => None,
            EncryptionMode::VerifyCa | EncryptionMode::VerifyFull => {
                let (roots, known) = authorities(address.authorities.as_deref())?;
                let chain =
                    WebPkiServerVerifier::builder_with_provider(Arc::new(roots), Arc::clone(&provider))
                        .build();
                let chain = chain.map_err(|error| {
                    Error::data(format!("the certificates of authorities cannot be used: {error}"))
                        .help("name a file of certificates in PEM: sslrootcert=FILE")
                })?;
                let names = address.encryption == EncryptionMode::VerifyFull;
                Some(ChainVerifier { chain, known, names })
            }
        };
        let verifier = Arc::new(ServerVerifier { provider: Arc::clone(&provider), chain });
        let versions = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions();
        let config = versions
            .map_err(|error| Error::internal(format!("TLS: {error}")))?
            .dangerous()
            .with_custom_certificate_verifier(verifier)
            .with_no_client_auth();
        Ok(Self { config: Arc::new(config) })
    }
}

/// Returns the TLS mode for a mode of encryption.
pub(super) fn mode(encryption: EncryptionMode) -> SslMode {
    match encryption {
        EncryptionMode::Disable => SslMode::Disable,
        EncryptionMode::Prefer => SslMode::Prefer,
        EncryptionMode::Require | EncryptionMode::VerifyCa | EncryptionMode::VerifyFull => SslMode::Require,
    }
}

/// Reads the certificates of authorities in a file, or those of the system.
fn authorities(file: Option<&Path>) -> Result<(RootCertStore, Vec<CertificateDer<'static>>)> {
    let named = std::env::var_os("SSL_CERT_FILE").map(std::path::PathBuf::from);
    let known = BUNDLES.iter().map(Path::new).find(|path| path.is_file());
    let Some(path) = file.or(named.as_deref()).or(known) else {
        return Err(Error::unavailable("there is no file with the certificates of authorities")
            .help("name a file of certificates in PEM: sslrootcert=FILE"));
    };
    let unread = |why: &str| {
        Error::file(path, format!("cannot read the certificates in {}: {why}", path.display()))
            .help("name a file of certificates in PEM: sslrootcert=FILE")
    };
    let text = burgeon_base::files::read(path, 20_000_000).map_err(|error| unread(&error.to_string()))?;
    let (mut roots, mut known) = (RootCertStore::empty(), Vec::new());
    for certificate in CertificateDer::pem_slice_iter(&text) {
        let certificate = certificate.map_err(|error| unread(&error.to_string()))?;
        // The system's bundle may contain unusable certificates, which are skipped.
        let added = roots.add(certificate.clone());
        if file.is_some() {
            added.map_err(|error| unread(&error.to_string()))?;
        }
        known.push(certificate);
    }
    if roots.is_empty() { Err(unread("it holds none")) } else { Ok((roots, known)) }
}

/// Reports whether a certificate was refused because it is the certificate of an authority.
fn is_authority(error: &OtherError) -> bool {
    matches!(error.0.downcast_ref(), Some(webpki::Error::CaUsedAsEndEntity))
}

/// The verifier of server certificates, as strict as an address specifies.
#[derive(Debug)]
struct ServerVerifier {
    provider: Arc<CryptoProvider>,
    chain: Option<ChainVerifier>,
}

/// The verifier that a certificate is signed by an authority, or is the certificate of an authority.
#[derive(Debug)]
struct ChainVerifier {
    chain: Arc<WebPkiServerVerifier>,
    /// Certificates of the authorities.
    known: Vec<CertificateDer<'static>>,
    /// Set if the name of the server is verified too.
    names: bool,
}

impl ServerCertVerifier for ServerVerifier {
    fn verify_server_cert(
        &self,
        end_entity: &CertificateDer<'_>,
        intermediates: &[CertificateDer<'_>],
        server_name: &ServerName<'_>,
        ocsp_response: &[u8],
        now: UnixTime,
    ) -> Result<ServerCertVerified, TlsError> {
        let Some(ChainVerifier { chain, known, names }) = &self.chain else {
            return Ok(ServerCertVerified::assertion());
        };
        match chain.verify_server_cert(end_entity, intermediates, server_name, ocsp_response, now) {
            // The name is verified last, so all other checks have passed.
            Err(TlsError::InvalidCertificate(
                CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. },
            )) if !names => Ok(ServerCertVerified::assertion()),
            // A server may use the certificate of an authority itself. Its validity period is verified before this
            // error.
            Err(TlsError::InvalidCertificate(CertificateError::Other(error)))
                if is_authority(&error) && known.contains(end_entity) =>
            {
                if *names {
                    verify_server_name(&ParsedCertificate::try_from(end_entity)?, server_name)?;
                }
                Ok(ServerCertVerified::assertion())
            }
            verified => verified,
        }
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, TlsError> {
        let algorithms = &self.provider.signature_verification_algorithms;
        verify_tls12_signature(message, certificate, signed, algorithms)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, TlsError> {
        let algorithms = &self.provider.signature_verification_algorithms;
        verify_tls13_signature(message, certificate, signed, algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.provider.signature_verification_algorithms.supported_schemes()
    }
}

impl<S> MakeTlsConnect<S> for Encryption
where
    S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
{
    type Stream = EncryptedStream<S>;
    type TlsConnect = Handshake;
    type Error = io::Error;

    fn make_tls_connect(&mut self, domain: &str) -> io::Result<Handshake> {
        let name = ServerName::try_from(domain.to_owned()).map_err(io::Error::other)?;
        Ok(Handshake { config: Arc::clone(&self.config), name })
    }
}

/// A handshake that has not begun.
pub(super) struct Handshake {
    config: Arc<ClientConfig>,
    name: ServerName<'static>,
}

impl<S> TlsConnect<S> for Handshake
where
    S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
{
    type Stream = EncryptedStream<S>;
    type Error = io::Error;
    type Future = Pin<Box<dyn Future<Output = io::Result<EncryptedStream<S>>> + Send>>;

    fn connect(self, stream: S) -> Self::Future {
        let connector = tokio_rustls::TlsConnector::from(self.config);
        Box::pin(async move { connector.connect(self.name, stream).await.map(EncryptedStream) })
    }
}

/// An encrypted connection.
pub(super) struct EncryptedStream<S>(tokio_rustls::client::TlsStream<S>);

impl<S: AsyncRead + AsyncWrite + Unpin> TlsStream for EncryptedStream<S> {
    fn channel_binding(&self) -> ChannelBinding {
        ChannelBinding::none()
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin> AsyncRead for EncryptedStream<S> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.0).poll_read(context, buffer)
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin> AsyncWrite for EncryptedStream<S> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.0).poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.0).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.0).poll_shutdown(context)
    }
}
